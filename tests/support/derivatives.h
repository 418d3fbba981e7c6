#pragma once

#include "forces/elements.h"
#include "support/random_rotation.h"

#include <functional>

/// Finite differences, and the ways between elements' arrays and plain vectors and matrices.
namespace weft::test {

using VecX = Eigen::VectorXd;
using MatX = Eigen::MatrixXd;

/// Central differences of a scalar function with the step `delta` in each coordinate.
VecX numerical_gradient(const std::function<double(const VecX&)>& f, VecX x, double delta);

/// Central differences of a vector function; column i is the derivative by x_i.
MatX numerical_jacobian(const std::function<VecX(const VecX&)>& f, VecX x, double delta);

/// Eigenvalues of a symmetric matrix, ascending. It is here so that one file compiles the solver.
VecX eigenvalues(const MatX& symmetric);

template <int N> VecX flat(const std::array<Vec3, static_cast<std::size_t>(N)>& values) {
    VecX x(3 * N);
    for (int k = 0; k < N; ++k) {
        x.segment<3>(3 * k) = values[static_cast<std::size_t>(k)];
    }
    return x;
}

template <int N> std::array<Vec3, static_cast<std::size_t>(N)> corners(const VecX& x) {
    std::array<Vec3, static_cast<std::size_t>(N)> values;
    for (int k = 0; k < N; ++k) {
        values[static_cast<std::size_t>(k)] = x.segment<3>(3 * k);
    }
    return values;
}

/// The whole matrix of an element from the blocks of its upper triangle.
template <int N>
MatX assembled(const std::array<Mat3, static_cast<std::size_t>(block_count(N))>& blocks) {
    MatX K(3 * N, 3 * N);
    for (int a = 0; a < N; ++a) {
        for (int b = a; b < N; ++b) {
            K.block<3, 3>(3 * a, 3 * b) = blocks[block_index(N, a, b)];
            K.block<3, 3>(3 * b, 3 * a) = blocks[block_index(N, a, b)].transpose();
        }
    }
    return K;
}

} // namespace weft::test
