#include "heat_weights.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace weft {

using Vec3 = Eigen::Vector3d;

namespace {

/// Strength of the bones' hold against the flow over the surface. Larger: sharper joints.
constexpr double k_hold = 1.0;

/// Cotangents that obtuse triangles make small or negative are kept at this: weights stay in [0,1].
constexpr double k_least_cotangent = 0.02;

double distance_to(const BonePiece& bone, const Vec3& p) {
    const Vec3 along = bone.to - bone.from;
    const double s = std::clamp((p - bone.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (p - bone.from - s * along).norm();
}

/// The piece whose flesh is nearest.
const BonePiece& nearest_bone(const Skeleton& skeleton, const Vec3& p) {
    const BonePiece* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const BonePiece& bone : skeleton.pieces) {
        const double distance = distance_to(bone, p) - bone.radius;
        if (distance < least) {
            least = distance;
            best = &bone;
        }
    }
    return *best;
}

} // namespace

Eigen::MatrixXd heat_weights(const Figure& figure, const Skeleton& skeleton) {
    using Triplet = Eigen::Triplet<double>;
    const auto n = static_cast<Eigen::Index>(figure.vertices.size());
    std::vector<Triplet> entries;
    Eigen::VectorXd area = Eigen::VectorXd::Constant(n, 1e-12);
    for (const auto& t : figure.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const int i = t[(k + 1) % 3];
            const int j = t[(k + 2) % 3];
            const Vec3 a = figure.vertices[static_cast<std::size_t>(i)] -
                           figure.vertices[static_cast<std::size_t>(t[k])];
            const Vec3 b = figure.vertices[static_cast<std::size_t>(j)] -
                           figure.vertices[static_cast<std::size_t>(t[k])];
            const double twice_area = a.cross(b).norm();
            const double c =
                0.5 * std::max(k_least_cotangent, a.dot(b) / std::max(twice_area, 1e-14));
            entries.insert(entries.end(), {{i, i, c}, {j, j, c}, {i, j, -c}, {j, i, -c}});
            area[t[k]] += twice_area / 6.0;
        }
    }
    Eigen::MatrixXd held = Eigen::MatrixXd::Zero(n, JointCount);
    for (Eigen::Index v = 0; v < n; ++v) {
        const Vec3& p = figure.vertices[static_cast<std::size_t>(v)];
        const BonePiece& bone = nearest_bone(skeleton, p);
        const double distance = std::max(0.01, distance_to(bone, p));
        const double hold = k_hold * area[v] / (distance * distance);
        entries.emplace_back(static_cast<int>(v), static_cast<int>(v), hold);
        held(v, bone.joint) = hold;
    }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    if (factor.info() != Eigen::Success) {
        throw std::runtime_error("the weights cannot be solved for");
    }
    Eigen::MatrixXd weights = factor.solve(held);
    weights = weights.cwiseMax(0.0);
    const Eigen::VectorXd sums = weights.rowwise().sum();
    return weights.array().colwise() / sums.array();
}

} // namespace weft
