#include "geometry/curvature.h"

#include <algorithm>
#include <cmath>

namespace weft {

double dihedral_angle(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
    const Vec3 e = x1 - x0;
    const Vec3 n1 = e.cross(x2 - x0);
    const Vec3 n2 = (x3 - x0).cross(e);
    const double length = e.norm();
    if (!(length > 0.0)) {
        return 0.0;
    }
    return std::atan2(n1.cross(n2).dot(e) / length, n1.dot(n2));
}

std::array<Vec3, 4>
dihedral_gradient(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
    const Vec3 e = x1 - x0;
    const Vec3 n1 = e.cross(x2 - x0);
    const Vec3 n2 = (x3 - x0).cross(e);
    const double length = e.norm();
    const double n1_squared = n1.squaredNorm();
    const double n2_squared = n2.squaredNorm();
    if (!(n1_squared > 0.0 && n2_squared > 0.0)) {
        return {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    }
    const Vec3 q1 = n1 / n1_squared;
    const Vec3 q2 = n2 / n2_squared;
    return {Vec3(((x1 - x2).dot(e) * q1 + (x1 - x3).dot(e) * q2) / length),
            Vec3(((x2 - x0).dot(e) * q1 + (x3 - x0).dot(e) * q2) / length), Vec3(-length * q1),
            Vec3(-length * q2)};
}

namespace {

/// edges[k] is the edge opposite to corner k, in any number of dimensions.
template <typename Vec>
std::array<double, 3> corner_areas(const std::array<Vec, 3>& edges, double area) {
    std::array<double, 3> cosines{}; // times the lengths of the sides that meet in corner k
    std::array<double, 3> squared{};
    for (std::size_t k = 0; k < 3; ++k) {
        cosines[k] = -edges[(k + 1) % 3].dot(edges[(k + 2) % 3]);
        squared[k] = edges[k].squaredNorm();
    }
    for (std::size_t k = 0; k < 3; ++k) {
        if (cosines[k] < 0.0) {
            std::array<double, 3> result{area / 4, area / 4, area / 4};
            result[k] = area / 2;
            return result;
        }
    }
    if (area <= 0.0) {
        return {0.0, 0.0, 0.0};
    }
    std::array<double, 3> result{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        result[k] = (squared[i] * cosines[i] + squared[j] * cosines[j]) / (16.0 * area);
    }
    return result;
}

} // namespace

std::array<double, 3> mixed_corner_areas(const std::array<Vec2, 3>& corners) {
    const std::array<Vec2, 3> edges{corners[2] - corners[1], corners[0] - corners[2],
                                    corners[1] - corners[0]};
    const double area = 0.5 * std::abs(edges[1].x() * edges[2].y() - edges[1].y() * edges[2].x());
    return corner_areas(edges, area);
}

std::array<double, 3> mixed_corner_areas(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
    return corner_areas(std::array<Vec3, 3>{x2 - x1, x0 - x2, x1 - x0}, triangle_area(x0, x1, x2));
}

std::vector<double> mixed_areas(std::span<const Vec3> positions,
                                std::span<const Triangle> triangles) {
    std::vector<double> areas(positions.size(), 0.0);
    for (const Triangle& t : triangles) {
        const auto corner_areas =
            mixed_corner_areas(positions[at(t[0])], positions[at(t[1])], positions[at(t[2])]);
        for (std::size_t k = 0; k < 3; ++k) {
            areas[at(t[k])] += corner_areas[k];
        }
    }
    return areas;
}

namespace {

/// Curvature across an inner edge, 1/m; 0 when its triangles have no height.
double edge_curvature(std::span<const Vec3> x, const MeshEdge& edge) {
    const Vec3& x0 = x[at(edge.v[0])];
    const Vec3& x1 = x[at(edge.v[1])];
    const Vec3& x2 = x[at(edge.apex[0])];
    const Vec3& x3 = x[at(edge.apex[1])];
    const double heights_times_length =
        2.0 * (triangle_area(x0, x1, x2) + triangle_area(x1, x0, x3));
    if (!(heights_times_length > 0.0)) {
        return 0.0;
    }
    return 2.0 * std::abs(dihedral_angle(x0, x1, x2, x3)) * (x1 - x0).norm() / heights_times_length;
}

/// Gives boundary vertices half the greatest curvature of the inner edges around them.
void replace_on_boundary(std::span<const Vec3> positions,
                         const EdgeTopology& topology,
                         std::vector<double>& curvatures) {
    std::vector<char> on_boundary(curvatures.size(), 0);
    for (const MeshEdge& edge : topology.edges) {
        if (edge.is_boundary()) {
            for (const Index v : edge.v) {
                on_boundary[at(v)] = 1;
                curvatures[at(v)] = 0.0;
            }
        }
    }
    for (const MeshEdge& edge : topology.edges) {
        const std::array<Index, 4> around{edge.v[0], edge.v[1], edge.apex[0], edge.apex[1]};
        if (edge.is_boundary() || std::none_of(around.begin(), around.end(),
                                               [&](Index v) { return on_boundary[at(v)] != 0; })) {
            continue;
        }
        const double mean = 0.5 * edge_curvature(positions, edge);
        for (const Index v : around) {
            if (on_boundary[at(v)]) {
                curvatures[at(v)] = std::max(curvatures[at(v)], mean);
            }
        }
    }
}

/// A corner with one triangle sees a single inner edge, which may lie along the flat direction.
void fill_lone_corners(std::span<const Triangle> triangles, std::vector<double>& curvatures) {
    std::vector<int> triangle_counts(curvatures.size(), 0);
    for (const Triangle& t : triangles) {
        for (const Index v : t) {
            ++triangle_counts[at(v)];
        }
    }
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (triangle_counts[at(t[k])] == 1) {
                curvatures[at(t[k])] =
                    std::max(curvatures[at(t[(k + 1) % 3])], curvatures[at(t[(k + 2) % 3])]);
            }
        }
    }
}

} // namespace

std::vector<Vec3> mean_curvature_normals(std::span<const Vec3> positions,
                                         std::span<const Triangle> triangles) {
    std::vector<Vec3> normals(positions.size(), Vec3::Zero());
    std::vector<double> areas(positions.size(), 0.0);
    for (const Triangle& t : triangles) {
        const Vec3& x0 = positions[at(t[0])];
        const Vec3& x1 = positions[at(t[1])];
        const Vec3& x2 = positions[at(t[2])];
        const double doubled_area = 2.0 * triangle_area(x0, x1, x2);
        if (!(doubled_area > 0.0)) {
            continue;
        }
        const auto corners = mixed_corner_areas(x0, x1, x2);
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = t[(k + 1) % 3];
            const Index b = t[(k + 2) % 3];
            const Vec3& apex = positions[at(t[k])];
            const double cotangent =
                (positions[at(a)] - apex).dot(positions[at(b)] - apex) / doubled_area;
            const Vec3 pull = cotangent * (positions[at(a)] - positions[at(b)]);
            normals[at(a)] += pull;
            normals[at(b)] -= pull;
            areas[at(t[k])] += corners[k];
        }
    }
    for (std::size_t i = 0; i < normals.size(); ++i) {
        if (areas[i] > 0.0) {
            normals[i] /= 2.0 * areas[i];
        }
    }
    return normals;
}

std::vector<double> mean_curvatures(std::span<const Vec3> positions,
                                    std::span<const Triangle> triangles,
                                    const EdgeTopology& topology) {
    const std::vector<Vec3> normals = mean_curvature_normals(positions, triangles);
    std::vector<double> curvatures(positions.size());
    std::transform(normals.begin(), normals.end(), curvatures.begin(),
                   [](const Vec3& normal) { return 0.5 * normal.norm(); });
    replace_on_boundary(positions, topology, curvatures);
    fill_lone_corners(triangles, curvatures);
    return curvatures;
}

} // namespace weft
