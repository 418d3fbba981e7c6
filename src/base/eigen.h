#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>

/// Eigen is our language; these are the words that every room uses.
namespace weft {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;
using Mat32 = Eigen::Matrix<double, 3, 2>;

/// Index of a vertex, triangle or edge in the array that its name says.
using Index = std::int32_t;
inline constexpr Index k_no_index = -1;

/// An index as containers count.
constexpr std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

/// Vertex indices of a triangle, counter-clockwise seen from its outer side.
using Triangle = std::array<Index, 3>;

/// [a]x: its product with b is the cross product of a and b.
inline Mat3 cross_matrix(const Vec3& a) {
    Mat3 m;
    m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
    return m;
}

} // namespace weft
