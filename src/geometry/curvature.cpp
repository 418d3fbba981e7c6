#include "geometry/curvature.h"

#include "geometry/dihedral.h"
#include "geometry/mixed_areas.h"

#include <algorithm>
#include <cmath>

namespace weft {

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
        const auto shares = mixed_corner_areas(x0, x1, x2);
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = t[(k + 1) % 3];
            const Index b = t[(k + 2) % 3];
            const Vec3& apex = positions[at(t[k])];
            const double cotangent =
                (positions[at(a)] - apex).dot(positions[at(b)] - apex) / doubled_area;
            const Vec3 pull = cotangent * (positions[at(a)] - positions[at(b)]);
            normals[at(a)] += pull;
            normals[at(b)] -= pull;
            areas[at(t[k])] += shares[k];
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
