#include "geometry/triangulate.h"

#include <numeric>

namespace weft {

namespace {

/// Twice the area vector of the polygon (Newell 1972).
Vec3 newell_normal(std::span<const Vec3> corners) {
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 a = corners[i] - corners[0];
        const Vec3 b = corners[(i + 1) % corners.size()] - corners[0];
        normal += a.cross(b);
    }
    return normal;
}

/// Whether both triangles on the diagonal from corner `i` to corner `i + 2` face along `normal`.
bool diagonal_lies_inside(std::span<const Vec3> q, std::size_t i, const Vec3& normal) {
    const Vec3& a = q[i];
    const Vec3& b = q[i + 1];
    const Vec3& c = q[(i + 2) % 4];
    const Vec3& d = q[(i + 3) % 4];
    return (b - a).cross(c - a).dot(normal) > 0.0 && (c - a).cross(d - a).dot(normal) > 0.0;
}

std::vector<Triangle> triangulate_quad(std::span<const Vec3> q) {
    const Vec3 normal = newell_normal(q);
    const bool first = diagonal_lies_inside(q, 0, normal);
    const bool second = diagonal_lies_inside(q, 1, normal);
    const bool second_is_shorter = (q[3] - q[1]).norm() < 0.999 * (q[2] - q[0]).norm();
    if (second && (second_is_shorter || !first)) {
        return {{0, 1, 3}, {1, 2, 3}};
    }
    return {{0, 1, 2}, {0, 2, 3}};
}

double cross_2d(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

std::vector<Vec2> project(std::span<const Vec3> corners) {
    const Vec3 normal = newell_normal(corners).normalized();
    Index axis = 0;
    normal.cwiseAbs().minCoeff(&axis);
    const Vec3 u = normal.cross(Vec3::Unit(axis)).normalized();
    const Vec3 v = normal.cross(u);
    std::vector<Vec2> flat;
    flat.reserve(corners.size());
    for (const Vec3& corner : corners) {
        flat.emplace_back((corner - corners[0]).dot(u), (corner - corners[0]).dot(v));
    }
    return flat;
}

/// The corners that ear clipping has not cut off yet.
class EarClipper {
public:
    explicit EarClipper(std::span<const Vec3> corners)
        : flat_(project(corners)), left_(corners.size()) {
        std::iota(left_.begin(), left_.end(), 0);
    }

    std::vector<Triangle> run() {
        std::vector<Triangle> triangles;
        std::size_t ear = 0;
        while (left_.size() >= 3) {
            ear = next_ear(ear);
            triangles.push_back({left(ear + left_.size() - 1), left(ear), left(ear + 1)});
            left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
            // Going on behind the neighbour cuts strips; staying would cut a fan of slivers.
            ear = (ear + 1) % left_.size();
            if (left_.size() < 3) {
                break;
            }
        }
        return triangles;
    }

private:
    Index left(std::size_t i) const { return left_[i % left_.size()]; }
    const Vec2& point(Index i) const { return flat_[at(i)]; }

    /// First ear at or after `start`; a polygon without one (it crosses itself) gives `start`.
    std::size_t next_ear(std::size_t start) const {
        for (std::size_t i = 0; i < left_.size(); ++i) {
            const std::size_t ear = (start + i) % left_.size();
            if (is_ear(ear)) {
                return ear;
            }
        }
        return start % left_.size();
    }

    bool is_ear(std::size_t ear) const {
        const Vec2& a = point(left(ear + left_.size() - 1));
        const Vec2& b = point(left(ear));
        const Vec2& c = point(left(ear + 1));
        if (cross_2d(b - a, c - a) <= 0.0) {
            return false;
        }
        for (const Index other : left_) {
            const Vec2& p = point(other);
            // Corners that coincide with a, b or c (the two sides of a cut to a hole) are no
            // obstacle.
            if (p == a || p == b || p == c) {
                continue;
            }
            if (cross_2d(b - a, p - a) >= 0.0 && cross_2d(c - b, p - b) >= 0.0 &&
                cross_2d(a - c, p - c) >= 0.0) {
                return false;
            }
        }
        return true;
    }

    std::vector<Vec2> flat_;
    std::vector<Index> left_;
};

} // namespace

std::vector<Triangle> triangulate_polygon(std::span<const Vec3> corners) {
    if (corners.size() < 3) {
        return {};
    }
    if (corners.size() == 3) {
        return {{0, 1, 2}};
    }
    if (corners.size() == 4) {
        return triangulate_quad(corners);
    }
    return EarClipper(corners).run();
}

} // namespace weft
