#pragma once

#include "base/eigen.h"

#include <array>
#include <cstddef>
#include <span>

/// What every set of force elements has in common, so that one assembler serves them all.
///
/// A set is built from one Cloth, speaks of that cloth's own vertex indices and has
///
///     static constexpr int k_nodes                    vertices an element
///     std::size_t size() const                        elements
///     std::span<const Index> nodes() const            k_nodes an element; k_no_index: none there
///     double energy(x) const                          J
///     void forces(x, v, element_forces) const         k_nodes an element, N
///     void evaluate(x, v, scales, element_forces, element_blocks) const
///                                                     and block_count(k_nodes) blocks an element;
///                                                     with k_is_difference one: that of each of
///                                                     two nodes, its negative between them
///     std::vector<Index> update(cloth, changes)       to the set that the cloth as it is now would
///                                                     give; slots of elements that differ,
///                                                     ascending, beyond the new size left out
///
/// Force and blocks of a missing node are zero. All loops allocate nothing and give the same bits
/// for any number of threads. Bending with a constant matrix is apart: forces/constant_bending.h.
namespace weft {

/// Blocks of the upper triangle of an element with n vertices.
constexpr int block_count(int n) {
    return n * (n + 1) / 2;
}

/// Place of block (a, b), a <= b, among the upper triangle's blocks stored row by row.
constexpr std::size_t block_index(int n, int a, int b) {
    return static_cast<std::size_t>(a * n - a * (a - 1) / 2 + (b - a));
}

/// Energy, force and stiffness of one element of N vertices.
template <int N> struct ElementTerms {
    double energy = 0.0;       ///< elastic, J
    std::array<Vec3, N> force; ///< on each vertex, damping included, N
    std::array<Mat3, static_cast<std::size_t>(block_count(N))>
        stiffness; ///< upper triangle row by row: (0,0), (0,1) .. (0,N-1), (1,1) ..; N/m
};

/// The factors that an implicit integrator gives stiffness and damping in its system: the blocks
/// written are stiffness * K + damping * D with K = -df/dx made positive semidefinite and
/// D = -df/dv. Implicit Euler: {dt^2, dt}.
struct SystemScales {
    double stiffness = 1.0;
    double damping = 0.0;
};

} // namespace weft
