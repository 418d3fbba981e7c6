#include "geometry/extent.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace weft {

namespace {

constexpr int k_axes = 6;     // first in the table; -y is the fourth
constexpr int k_down = 3;     // index of -y
constexpr int k_spread = 122; // more: closer to the hull, slower. These leave 10 degrees between.
constexpr int k_directions = k_axes + k_spread;

using Directions = Eigen::Matrix<double, k_directions, 3>;

/// The axes, then a Fibonacci spiral over the sphere.
const Directions& directions() {
    static const Directions table = [] {
        Directions d;
        for (int axis = 0; axis < 3; ++axis) {
            d.row(2 * axis) = Vec3::Unit(axis);
            d.row(2 * axis + 1) = -Vec3::Unit(axis);
        }
        for (int i = 0; i < k_spread; ++i) {
            const double y = 1.0 - 2.0 * (i + 0.5) / k_spread;
            const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
            const double r = std::sqrt(1.0 - y * y);
            d.row(k_axes + i) = Vec3(r * std::cos(angle), y, r * std::sin(angle));
        }
        return d;
    }();
    return table;
}

} // namespace

Extent::Extent() : reach_(k_directions, -std::numeric_limits<double>::infinity()) {}

Extent::Extent(const Box3& box) : Extent() {
    for (int i = 0; i < 8 && !box.isEmpty(); ++i) {
        extend(box.corner(static_cast<Box3::CornerType>(i)));
    }
}

void Extent::extend(const Vec3& x) {
    assert(x.allFinite());
    if (points_.empty()) {
        points_.assign(k_directions, x);
    }
    const Eigen::Matrix<double, k_directions, 1> along = directions() * x;
    for (std::size_t i = 0; i < k_directions; ++i) {
        const double reach = along[static_cast<Eigen::Index>(i)];
        if (reach > reach_[i]) {
            reach_[i] = reach;
            points_[i] = x;
        }
    }
}

void Extent::extend(const Extent& other) {
    for (const Vec3& x : other.points_) {
        extend(x);
    }
}

Box3 Extent::box() const {
    Box3 box;
    for (std::size_t i = 0; i < k_axes && !is_empty(); ++i) {
        box.extend(points_[i]);
    }
    return box;
}

double Extent::excess_over(const Extent& other) const {
    assert(!is_empty() && !other.is_empty());
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < k_directions; ++i) {
        most = std::max(most, reach_[i] - other.reach_[i]);
    }
    return most;
}

double Extent::excess_below(const Extent& other) const {
    assert(!is_empty() && !other.is_empty());
    return reach_[k_down] - other.reach_[k_down];
}

} // namespace weft
