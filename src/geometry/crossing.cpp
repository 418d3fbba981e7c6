#include "geometry/crossing.h"

#include "geometry/box_tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <vector>

namespace weft {

namespace {

const Vec3& point(std::span<const Vec3> x, Index i) {
    return x[at(i)];
}

bool holds(const Triangle& t, Index v) {
    return t[0] == v || t[1] == v || t[2] == v;
}

/// Does the side of s opposite to corner k meet t, with no vertex in it?
bool side_pierces(const Triangle& s, std::size_t k, const Triangle& t, std::span<const Vec3> x) {
    const Index p = s[(k + 1) % 3];
    const Index q = s[(k + 2) % 3];
    return !holds(t, p) && !holds(t, q) &&
           segment_meets_triangle(point(x, p), point(x, q), point(x, t[0]), point(x, t[1]),
                                  point(x, t[2]));
}

/// Corner opposite to the first side of s that meets t and has no vertex in it.
std::optional<std::size_t> piercing_side(const Triangle& s,
                                         const Triangle& t,
                                         std::span<const Vec3> x,
                                         const std::array<bool, 3>& shared = {}) {
    for (std::size_t k = 0; k < 3; ++k) {
        if (!shared[(k + 1) % 3] && !shared[(k + 2) % 3] && side_pierces(s, k, t, x)) {
            return k;
        }
    }
    return std::nullopt;
}

Vec3 place_on_side(const Triangle& s, std::size_t k, const Triangle& t, std::span<const Vec3> x) {
    const Vec3& p = point(x, s[(k + 1) % 3]);
    const Vec3& q = point(x, s[(k + 2) % 3]);
    const Vec3& a = point(x, t[0]);
    const Vec3 n = (point(x, t[1]) - a).cross(point(x, t[2]) - a);
    const double height_p = n.dot(p - a);
    const double height_q = n.dot(q - a);
    const double span = height_p - height_q;
    return span != 0.0 ? Vec3(p + std::clamp(height_p / span, 0.0, 1.0) * (q - p)) : p;
}

} // namespace

bool segment_meets_triangle(
    const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
    const int side_p = orientation(a, b, c, p);
    const int side_q = orientation(a, b, c, q);
    if (side_p * side_q > 0 || (side_p == 0 && side_q == 0)) {
        return false;
    }
    const int ab = orientation(p, q, a, b);
    const int bc = orientation(p, q, b, c);
    const int ca = orientation(p, q, c, a);
    const bool all_left = ab >= 0 && bc >= 0 && ca >= 0;
    const bool all_right = ab <= 0 && bc <= 0 && ca <= 0;
    return all_left || all_right;
}

bool triangles_cross(const Triangle& s,
                     const Triangle& t,
                     std::span<const Vec3> x,
                     const SharedCorners& shared) {
    return piercing_side(s, t, x, shared.s).has_value() ||
           piercing_side(t, s, x, shared.t).has_value();
}

std::array<Vec3, 2>
crossing_segment(const Triangle& s, const Triangle& t, std::span<const Vec3> x) {
    std::vector<Vec3> places;
    for (std::size_t k = 0; k < 3; ++k) {
        if (side_pierces(s, k, t, x)) {
            places.push_back(place_on_side(s, k, t, x));
        }
        if (side_pierces(t, k, s, x)) {
            places.push_back(place_on_side(t, k, s, x));
        }
        if (holds(t, s[k])) {
            places.push_back(point(x, s[k])); // neighbours cross from the corner that they share
        }
    }
    assert(!places.empty());
    std::array<Vec3, 2> ends{places[0], places[0]};
    for (const Vec3& a : places) {
        for (const Vec3& b : places) {
            if ((a - b).squaredNorm() > (ends[0] - ends[1]).squaredNorm()) {
                ends = {a, b};
            }
        }
    }
    return ends;
}

Vec3 crossing_place(const Triangle& s, const Triangle& t, std::span<const Vec3> x) {
    if (const auto k = piercing_side(s, t, x)) {
        return place_on_side(s, *k, t, x);
    }
    const auto k = piercing_side(t, s, x);
    return place_on_side(t, k.value_or(0), s, x);
}

std::vector<std::array<Index, 2>> find_self_crossings(const TriangleMesh& mesh) {
    const auto x = [&](Index v) -> const Vec3& { return mesh.positions[at(v)]; };
    std::vector<Box> boxes;
    boxes.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        boxes.push_back(
            unite(segment_box(x(t[0]), x(t[1]), 0.0), segment_box(x(t[2]), x(t[2]), 0.0)));
    }
    std::vector<std::array<Index, 2>> crossings;
    if (boxes.empty()) {
        return crossings;
    }
    const BoxTree tree{std::span<const Box>(boxes)};
    std::vector<BoxTree::Task> tasks;
    BoxTree::split(tree, tree, 1, tasks);
    for (const BoxTree::Task& task : tasks) {
        BoxTree::overlaps(tree, tree, task, [&](Index s, Index t) {
            if (triangles_cross(mesh.triangles[at(s)], mesh.triangles[at(t)], mesh.positions)) {
                crossings.push_back({std::min(s, t), std::max(s, t)});
            }
        });
    }
    std::sort(crossings.begin(), crossings.end());
    return crossings;
}

namespace {

/// Sine of the angle between edge and face below which the edge counts as lying in it: its foot
/// point would run away.
constexpr double k_least_slope = 1e-3;

} // namespace

std::optional<Vec3>
contour_gradient(const Vec3& p, const Vec3& q, std::span<const Vec3> apexes, const Vec3& normal) {
    const Vec3 edge = (q - p).normalized();
    double slope = edge.dot(normal);
    slope = std::copysign(std::max(std::abs(slope), k_least_slope), slope);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& apex : apexes) {
        const Vec3 line = edge.cross(apex - p).cross(normal); // the two planes' common direction
        const double length = line.norm();
        if (length <= 0.0) {
            continue;
        }
        const Vec3 inward = (apex - p) - edge.dot(apex - p) * edge;
        const Vec3 contour = std::copysign(1.0 / length, line.dot(inward)) * line;
        sum += contour - 2.0 * edge.dot(contour) / slope * normal;
    }
    const double length = sum.norm();
    return length > 1e-9 ? std::optional<Vec3>(sum / length) : std::nullopt;
}

namespace {

/// (7 + 56 eps) eps with eps = 2^-53: Shewchuk's bound of the rounding of the determinant,
/// relative to the sum of the magnitudes of its terms.
constexpr double k_filter = 7.7715611723761027e-16;

/// A number as a sum of doubles that do not overlap, smallest first. Long enough for the
/// determinant below: 3 * (2 * (2 * 2 * 2) * 2 * 2) = 192 terms.
class Expansion {
public:
    Expansion() = default;

    /// a - b, exactly.
    static Expansion difference(double a, double b) {
        Expansion e;
        const double x = a - b;
        const double virtual_b = a - x;
        const double virtual_a = x + virtual_b;
        e.push((a - virtual_a) + (virtual_b - b));
        e.push(x);
        return e;
    }

    Expansion& operator+=(const Expansion& other) {
        for (int i = 0; i < other.size_; ++i) {
            grow(other.term(i));
        }
        return *this;
    }

    Expansion operator-() const {
        Expansion e;
        for (int i = 0; i < size_; ++i) {
            e.push(-term(i));
        }
        return e;
    }

    Expansion operator*(const Expansion& other) const {
        Expansion product;
        for (int i = 0; i < size_; ++i) {
            for (int j = 0; j < other.size_; ++j) {
                const double high = term(i) * other.term(j);
                product.grow(std::fma(term(i), other.term(j), -high));
                product.grow(high);
            }
        }
        return product;
    }

    int sign() const {
        const double leading = size_ > 0 ? term(size_ - 1) : 0.0;
        return (leading > 0.0) - (leading < 0.0);
    }

private:
    double term(int i) const { return terms_[at(i)]; }

    void push(double x) {
        if (x != 0.0) {
            assert(size_ < 192);
            terms_[at(size_++)] = x;
        }
    }

    /// Adds one double (Shewchuk's Grow-Expansion, dropping zeros).
    void grow(double q) {
        const int old_size = size_;
        size_ = 0;
        for (int i = 0; i < old_size; ++i) {
            const double e = term(i);
            const double sum = q + e;
            const double virtual_e = sum - q;
            push((q - (sum - virtual_e)) + (e - virtual_e));
            q = sum;
        }
        push(q);
    }

    std::array<double, 192> terms_;
    int size_ = 0;
};

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    std::array<std::array<Expansion, 3>, 3> m;
    const std::array<const Vec3*, 3> rows{&a, &b, &c};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<Eigen::Index>(k);
            m[i][k] = Expansion::difference((*rows[i])[axis], d[axis]);
        }
    }
    Expansion determinant;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& p = m[(i + 1) % 3];
        const auto& q = m[(i + 2) % 3];
        Expansion minor = p[0] * q[1];
        minor += -(p[1] * q[0]);
        determinant += minor * m[i][2];
    }
    return determinant.sign();
}

} // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 p = a - d;
    const Vec3 q = b - d;
    const Vec3 r = c - d;
    const double qr = q[0] * r[1];
    const double rq = q[1] * r[0];
    const double rp = r[0] * p[1];
    const double pr = r[1] * p[0];
    const double pq = p[0] * q[1];
    const double qp = p[1] * q[0];
    const double determinant = p[2] * (qr - rq) + q[2] * (rp - pr) + r[2] * (pq - qp);
    const double magnitude = std::abs(p[2]) * (std::abs(qr) + std::abs(rq)) +
                             std::abs(q[2]) * (std::abs(rp) + std::abs(pr)) +
                             std::abs(r[2]) * (std::abs(pq) + std::abs(qp));
    if (std::abs(determinant) > k_filter * magnitude) {
        return determinant > 0.0 ? 1 : -1;
    }
    return exact_orientation(a, b, c, d);
}

} // namespace weft
