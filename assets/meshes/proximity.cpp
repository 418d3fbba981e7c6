#include "proximity.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft {
namespace {

using Corners = std::array<Vec3, 3>;

Corners corners(const ObjMesh& mesh, size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return {mesh.vertices[static_cast<size_t>(a)], mesh.vertices[static_cast<size_t>(b)],
            mesh.vertices[static_cast<size_t>(c)]};
}

Vec3 low_corner(const Corners& x) {
    return x[0].cwiseMin(x[1]).cwiseMin(x[2]);
}
Vec3 high_corner(const Corners& x) {
    return x[0].cwiseMax(x[1]).cwiseMax(x[2]);
}

double point_segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - t * (b - a)).norm();
}

double point_triangle_distance(const Vec3& p, const Corners& x) {
    const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]);
    bool is_above = true;
    double to_border = point_segment_distance(p, x[2], x[0]);
    for (size_t k = 0; k < 3; ++k) {
        const Vec3& a = x[k];
        const Vec3& b = x[(k + 1) % 3];
        is_above = is_above && (b - a).cross(p - a).dot(normal) >= 0.0;
        to_border = std::min(to_border, point_segment_distance(p, a, b));
    }
    return is_above ? std::abs((p - x[0]).dot(normal.normalized())) : to_border;
}

double segment_segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    double least = std::min({point_segment_distance(a, c, d), point_segment_distance(b, c, d),
                             point_segment_distance(c, a, b), point_segment_distance(d, a, b)});
    const Vec3 e = b - a;
    const Vec3 f = d - c;
    const Vec3 n = e.cross(f);
    if (n.squaredNorm() > 0.0) {
        const double s = (c - a).cross(f).dot(n) / n.squaredNorm();
        const double t = (c - a).cross(e).dot(n) / n.squaredNorm();
        if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)
            least = std::min(least, std::abs((c - a).dot(n.normalized())));
    }
    return least;
}

double triangle_distance(const Corners& x, const Corners& y) {
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < 3; ++i) {
        least =
            std::min({least, point_triangle_distance(x[i], y), point_triangle_distance(y[i], x)});
        for (size_t j = 0; j < 3; ++j)
            least = std::min(least,
                             segment_segment_distance(x[i], x[(i + 1) % 3], y[j], y[(j + 1) % 3]));
    }
    return least;
}

/// Six times the signed volume of a tetrahedron.
double orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a);
}

bool crosses(const Vec3& p, const Vec3& q, const Corners& x) {
    const double side_p = orientation(x[0], x[1], x[2], p);
    const double side_q = orientation(x[0], x[1], x[2], q);
    // A flat cloth lies in one plane; within it nothing is said to cross.
    if (side_p * side_q > 0.0 || (side_p == 0.0 && side_q == 0.0))
        return false;
    const double u = orientation(p, q, x[0], x[1]);
    const double v = orientation(p, q, x[1], x[2]);
    const double w = orientation(p, q, x[2], x[0]);
    return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
}

bool contains(const Triangle& triangle, VertexIndex v) {
    return std::find(triangle.begin(), triangle.end(), v) != triangle.end();
}

} // namespace

template <class Visit>
void TriangleGrid::for_cells(const Vec3& low, const Vec3& high, Visit visit) const {
    const auto cell = [this](double value) {
        return static_cast<long long>(std::floor(value / cell_size_)) + 100000;
    };
    for (long long i = cell(low.x()); i <= cell(high.x()); ++i)
        for (long long j = cell(low.y()); j <= cell(high.y()); ++j)
            for (long long k = cell(low.z()); k <= cell(high.z()); ++k)
                visit((i << 40) + (j << 20) + k);
}

TriangleGrid::TriangleGrid(const ObjMesh& mesh, double cell_size) : cell_size_(cell_size) {
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Corners x = corners(mesh, t);
        for_cells(low_corner(x), high_corner(x),
                  [this, t](long long key) { cells_[key].push_back(static_cast<int>(t)); });
    }
}

std::vector<int> TriangleGrid::find(const Vec3& low, const Vec3& high) const {
    std::vector<int> result;
    for_cells(low, high, [this, &result](long long key) {
        if (const auto place = cells_.find(key); place != cells_.end())
            result.insert(result.end(), place->second.begin(), place->second.end());
    });
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

int count_crossings(const ObjMesh& a, const ObjMesh& b, bool is_same) {
    const TriangleGrid grid(b, 0.03);
    int count = 0;
    for (const Triangle& triangle : a.triangles)
        for (size_t k = 0; k < 3; ++k) {
            const VertexIndex v = triangle[k];
            const VertexIndex w = triangle[(k + 1) % 3];
            const Vec3& p = a.vertices[static_cast<size_t>(v)];
            const Vec3& q = a.vertices[static_cast<size_t>(w)];
            for (const int t : grid.find(p.cwiseMin(q), p.cwiseMax(q))) {
                const auto i = static_cast<size_t>(t);
                if (is_same && (contains(b.triangles[i], v) || contains(b.triangles[i], w)))
                    continue;
                count += crosses(p, q, corners(b, i)) ? 1 : 0;
            }
        }
    return count;
}

double least_distance(const ObjMesh& a, const ObjMesh& b, double farthest) {
    const TriangleGrid grid(b, 0.03);
    double least = farthest;
    for (size_t t = 0; t < a.triangles.size(); ++t) {
        const Corners x = corners(a, t);
        const Vec3 margin = Vec3::Constant(least);
        for (const int other : grid.find(low_corner(x) - margin, high_corner(x) + margin))
            least = std::min(least, triangle_distance(x, corners(b, static_cast<size_t>(other))));
    }
    return least;
}

double
point_distance(const Vec3& point, const ObjMesh& mesh, const TriangleGrid& grid, double farthest) {
    double least = farthest;
    const Vec3 margin = Vec3::Constant(farthest);
    for (const int t : grid.find(point - margin, point + margin))
        least =
            std::min(least, point_triangle_distance(point, corners(mesh, static_cast<size_t>(t))));
    return least;
}

double winding_number(const Vec3& point, const ObjMesh& mesh) {
    double sum = 0.0;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        Corners x = corners(mesh, t);
        for (Vec3& corner : x)
            corner = (corner - point).normalized();
        // Half the solid angle, Van Oosterom and Strackee 1983.
        sum += std::atan2(x[0].dot(x[1].cross(x[2])),
                          1.0 + x[0].dot(x[1]) + x[1].dot(x[2]) + x[2].dot(x[0]));
    }
    return sum / (2.0 * std::acos(-1.0));
}

} // namespace weft
