#include "geometry/mesh_measure.h"

#include "geometry/mesh_check.h"
#include "geometry/mesh_repair.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

namespace weft {

namespace {

const Vec3& position(const TriangleMesh& mesh, Index v) {
    assert(v >= 0 && at(v) < mesh.positions.size());
    return mesh.positions[at(v)];
}

/// Angle at `apex` between the directions to `a` and `b`, rad; exact for thin triangles too.
double angle_at(const Vec3& apex, const Vec3& a, const Vec3& b) {
    const Vec3 u = a - apex;
    const Vec3 v = b - apex;
    return std::atan2(u.cross(v).norm(), u.dot(v));
}

void measure_triangles(const TriangleMesh& mesh, MeshMeasure& m) {
    m.least_angle = m.least_altitude = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& corners = mesh.triangles[t];
        const Vec3& a = position(mesh, corners[0]);
        const Vec3& b = position(mesh, corners[1]);
        const Vec3& c = position(mesh, corners[2]);
        const double angle = std::min({angle_at(a, b, c), angle_at(b, c, a), angle_at(c, a, b)});
        if (angle < m.least_angle) {
            m.least_angle = angle;
            m.least_angle_triangle = static_cast<Index>(t);
        }
        const double altitude = least_altitude(a, b, c);
        if (altitude < m.least_altitude) {
            m.least_altitude = altitude;
            m.least_altitude_triangle = static_cast<Index>(t);
        }
        m.area += triangle_area(a, b, c);
    }
}

void measure_edges(const TriangleMesh& mesh, const EdgeTopology& topology, MeshMeasure& m) {
    m.edges = topology.edges.size();
    m.edge_min = std::numeric_limits<double>::infinity();
    double sum = 0.0;
    for (const MeshEdge& edge : topology.edges) {
        const double length = (position(mesh, edge.v[1]) - position(mesh, edge.v[0])).norm();
        m.edge_min = std::min(m.edge_min, length);
        m.edge_max = std::max(m.edge_max, length);
        sum += length;
    }
    m.edge_mean = sum / static_cast<double>(m.edges);
}

void measure_loops(const TriangleMesh& mesh, const EdgeTopology& topology, MeshMeasure& m) {
    for (const std::vector<Index>& loop : boundary_loops(topology)) {
        LoopMeasure measure{loop.size(), 0.0};
        for (std::size_t i = 0; i < loop.size(); ++i) {
            measure.length +=
                (position(mesh, loop[(i + 1) % loop.size()]) - position(mesh, loop[i])).norm();
        }
        m.loops.push_back(measure);
    }
    std::stable_sort(m.loops.begin(), m.loops.end(),
                     [](const auto& a, const auto& b) { return a.length > b.length; });
}

} // namespace

MeshMeasure measure_mesh(const TriangleMesh& mesh) {
    MeshMeasure m;
    if (mesh.triangles.empty()) {
        return m;
    }
    Eigen::AlignedBox3d box;
    for (const Vec3& p : mesh.positions) {
        box.extend(p);
    }
    m.low = box.min();
    m.high = box.max();
    std::vector<int> part_of_triangle;
    m.parts = connected_parts(mesh.triangles, part_of_triangle);
    const EdgeTopology topology = build_edges(mesh.triangles);
    measure_triangles(mesh, m);
    measure_edges(mesh, topology, m);
    measure_loops(mesh, topology, m);
    m.is_closed = m.loops.empty();
    m.volume = m.is_closed ? enclosed_volume(mesh.positions, mesh.triangles) : 0.0;
    return m;
}

UvMeasure measure_uv(std::span<const Triangle> triangles,
                     std::span<const std::array<Vec2, 3>> corner_uv) {
    assert(triangles.size() == corner_uv.size());
    UvMeasure measure;
    std::vector<std::size_t> root(triangles.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&](std::size_t t) {
        while (root[t] != t) {
            root[t] = root[root[t]];
            t = root[t];
        }
        return t;
    };
    const auto uv_at = [&](Index triangle, Index vertex) {
        const auto t = at(triangle);
        const auto corner = std::find(triangles[t].begin(), triangles[t].end(), vertex);
        return corner_uv[t][static_cast<std::size_t>(corner - triangles[t].begin())];
    };
    // Exporters write uv with six digits; a jump below that is no seam.
    constexpr double k_same_uv = 1e-5;
    for (const MeshEdge& edge : build_edges(triangles).edges) {
        if (edge.is_boundary()) {
            continue;
        }
        const auto jump = [&](Index v) {
            return (uv_at(edge.triangle[0], v) - uv_at(edge.triangle[1], v)).norm();
        };
        if (jump(edge.v[0]) > k_same_uv || jump(edge.v[1]) > k_same_uv) {
            ++measure.seam_edges;
        } else {
            const std::size_t a = find(at(edge.triangle[0]));
            const std::size_t b = find(at(edge.triangle[1]));
            root[std::max(a, b)] = std::min(a, b);
        }
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        measure.islands += root[t] == t ? 1 : 0;
    }
    return measure;
}

MassMoments mass_moments(const TriangleMesh& mesh) {
    MassMoments moments;
    const Vec3 origin = mesh.positions[at(mesh.triangles[0][0])];
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    for (const Triangle& t : mesh.triangles) {
        const auto corner = [&](std::size_t k) { return Vec3(mesh.positions[at(t[k])] - origin); };
        const Vec3 a = corner(0);
        const Vec3 b = corner(1);
        const Vec3 c = corner(2);
        const double volume = a.dot(b.cross(c)) / 6.0;
        const Vec3 sum = a + b + c;
        moments.volume += volume;
        first += volume / 4.0 * sum;
        second +=
            volume / 20.0 *
            (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
    const Vec3 centre = first / moments.volume;
    moments.centre = origin + centre;
    moments.second = second / moments.volume - centre * centre.transpose();
    return moments;
}

namespace {

/// Neighbours of all vertices, those of v at [first[v], first[v + 1]); some stand twice.
struct Neighbours {
    std::vector<std::size_t> first;
    std::vector<Index> vertex;
};

Neighbours find_neighbours(std::size_t vertices, std::span<const Triangle> triangles) {
    Neighbours n;
    n.first.assign(vertices + 1, 0);
    for (const Triangle& t : triangles) {
        for (const Index v : t) {
            n.first[at(v) + 1] += 2;
        }
    }
    for (std::size_t v = 0; v < vertices; ++v) {
        n.first[v + 1] += n.first[v];
    }
    n.vertex.resize(n.first.back());
    std::vector<std::size_t> next = n.first;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            std::size_t& slot = next[at(t[k])];
            n.vertex[slot++] = t[(k + 1) % 3];
            n.vertex[slot++] = t[(k + 2) % 3];
        }
    }
    return n;
}

} // namespace

MeshDistances mesh_distances(std::span<const Vec3> positions,
                             std::span<const Triangle> triangles,
                             std::span<const double> start) {
    assert(start.size() == positions.size());
    const Neighbours neighbours = find_neighbours(positions.size(), triangles);
    MeshDistances result{{start.begin(), start.end()},
                         std::vector<Index>(positions.size(), k_no_index)};
    using Entry = std::pair<double, Index>; // equal costs: the lower vertex first, so no chance
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (std::size_t v = 0; v < start.size(); ++v) {
        if (start[v] < std::numeric_limits<double>::infinity()) {
            result.source[v] = static_cast<Index>(v);
            open.emplace(start[v], static_cast<Index>(v));
        }
    }
    while (!open.empty()) {
        const auto [cost, vertex] = open.top();
        open.pop();
        const auto v = at(vertex);
        if (cost > result.cost[v]) {
            continue; // a cheaper way was found meanwhile
        }
        for (std::size_t i = neighbours.first[v]; i < neighbours.first[v + 1]; ++i) {
            const auto w = at(neighbours.vertex[i]);
            const double to_w = cost + (positions[w] - positions[v]).norm();
            if (to_w < result.cost[w]) {
                result.cost[w] = to_w;
                result.source[w] = result.source[v];
                open.emplace(to_w, neighbours.vertex[i]);
            }
        }
    }
    return result;
}

} // namespace weft
