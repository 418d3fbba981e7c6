#include "geometry/winding_number.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace weft {

namespace {

constexpr Index k_most_in_leaf = 8;

/// A part further away than this many of its radii counts as a dipole. Smaller: errors above 0.01;
/// larger: slower.
constexpr double k_far = 5.0;

} // namespace

double winding_fraction(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 x = a - p;
    const Vec3 y = b - p;
    const Vec3 z = c - p;
    const double lx = x.norm();
    const double ly = y.norm();
    const double lz = z.norm();
    const double volume = x.dot(y.cross(z));
    const double base = lx * ly * lz + x.dot(y) * lz + y.dot(z) * lx + z.dot(x) * ly;
    return std::atan2(volume, base) / (2.0 * std::numbers::pi);
}

WindingNumber::WindingNumber(const TriangleMesh& mesh) : positions_(mesh.positions) {
    std::vector<Vec3> centres;
    for (const Triangle& t : mesh.triangles) {
        centres.push_back((positions_[at(t[0])] + positions_[at(t[1])] + positions_[at(t[2])]) /
                          3.0);
    }
    std::vector<Index> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    triangles_ = mesh.triangles;
    if (!order.empty()) {
        build(order, centres, 0);
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
        triangles_[i] = mesh.triangles[at(order[i])];
    }
    for (Node& node : nodes_) {
        measure(node);
    }
}

Index WindingNumber::build(std::span<Index> order, std::span<const Vec3> centres, Index first) {
    const auto here = static_cast<Index>(nodes_.size());
    nodes_.push_back({.first = first, .count = static_cast<Index>(order.size())});
    if (order.size() <= at(k_most_in_leaf)) {
        return here;
    }
    Vec3 low = centres[at(order[0])];
    Vec3 high = low;
    for (const Index t : order) {
        low = low.cwiseMin(centres[at(t)]);
        high = high.cwiseMax(centres[at(t)]);
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const std::size_t half = order.size() / 2;
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                     [&](Index s, Index t) {
                         const double at_s = centres[at(s)][axis];
                         const double at_t = centres[at(t)][axis];
                         return at_s != at_t ? at_s < at_t : s < t;
                     });
    build(order.first(half), centres, first);
    nodes_[at(here)].right = build(order.subspan(half), centres, first + static_cast<Index>(half));
    return here;
}

std::array<Vec3, 3> WindingNumber::corners(Index slot) const {
    const Triangle& t = triangles_[at(slot)];
    return {positions_[at(t[0])], positions_[at(t[1])], positions_[at(t[2])]};
}

void WindingNumber::measure(Node& node) const {
    double total = 0.0;
    for (Index slot = node.first; slot < node.first + node.count; ++slot) {
        const auto [a, b, c] = corners(slot);
        const Vec3 normal = 0.5 * (b - a).cross(c - a);
        const double area = normal.norm();
        node.area_normal += normal;
        node.centre += area / 3.0 * (a + b + c);
        total += area;
    }
    node.centre = total > 0.0 ? Vec3(node.centre / total) : corners(node.first)[0];
    for (Index slot = node.first; slot < node.first + node.count; ++slot) {
        for (const Vec3& x : corners(slot)) {
            node.radius = std::max(node.radius, (x - node.centre).norm());
        }
    }
}

double WindingNumber::around(const Vec3& p) const {
    double winding = 0.0;
    std::array<Index, 64> stack; // depth: log2(triangles), at most 31
    std::size_t top = 0;
    if (!nodes_.empty()) {
        stack[top++] = 0;
    }
    while (top > 0) {
        const Index i = stack[--top];
        const Node& node = nodes_[at(i)];
        const Vec3 away = node.centre - p;
        const double distance = away.norm();
        if (distance > k_far * node.radius) {
            winding += node.area_normal.dot(away) /
                       (4.0 * std::numbers::pi * distance * distance * distance);
        } else if (node.right == k_no_index) {
            for (Index slot = node.first; slot < node.first + node.count; ++slot) {
                const auto [a, b, c] = corners(slot);
                winding += winding_fraction(p, a, b, c);
            }
        } else {
            stack[top++] = node.right;
            stack[top++] = i + 1;
        }
    }
    return winding;
}

} // namespace weft
