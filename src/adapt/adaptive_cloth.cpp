#include "adapt/adaptive_cloth.h"

#include "adapt/rest_split.h"
#include "geometry/curvature.h"
#include "geometry/mesh_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <numbers>

namespace weft {

namespace {

bool is_seam(const Cloth& cloth, Index e) {
    constexpr double k_same_grain = k_same_grain_deg * std::numbers::pi / 180.0;
    const auto [A, B] = cloth.topology.edges[at(e)].triangle;
    const std::size_t in_A = corner_opposite(cloth.topology, A, e);
    const std::size_t in_B = corner_opposite(cloth.topology, B, e);
    const RestTriangle& first = cloth.rest[at(A)];
    const RestTriangle& second = cloth.rest[at(B)];
    const double length = rest_edge_length(first, static_cast<int>(in_A));
    const double other = rest_edge_length(second, static_cast<int>(in_B));
    return std::abs(length - other) > k_same_length * std::max(length, other) ||
           std::abs(frame_turn(first, in_A, second, in_B)) > k_same_grain;
}

} // namespace

void make_refinement(Cloth& cloth) {
    assert(cloth.rest.size() == cloth.triangles.size());
    Refinement& refinement = cloth.refinement;
    refinement = {};
    refinement.base_vertices = cloth.vertex_count;
    refinement.base_triangles = static_cast<Index>(cloth.triangles.size());
    refinement.base_edges = static_cast<Index>(cloth.topology.edges.size());
    refinement.triangles.resize(cloth.triangles.size());
    refinement.frozen.resize(cloth.triangles.size(), 0);
    refinement.locked.resize(cloth.topology.edges.size(), 0);
    for (Index e = 0; e < refinement.base_edges; ++e) {
        refinement.locked[at(e)] = !cloth.topology.edges[at(e)].is_boundary() && is_seam(cloth, e);
    }
}

namespace {

/// Rounding of sums and inverses of rest shapes, relative.
constexpr double k_rounding = 1e-9;

/// Relative difference allowed between the two rest lengths of an edge: what make_refinement leaves
/// unlocked, grown by a few flips.
constexpr double k_two_lengths = 1e-5;

std::string sizes_problem(const Cloth& cloth) {
    const Refinement& r = cloth.refinement;
    const std::size_t triangles = cloth.triangles.size();
    const std::size_t edges = cloth.topology.edges.size();
    const auto vertices = at(cloth.vertex_count);
    if (cloth.rest.size() != triangles || r.triangles.size() != triangles ||
        cloth.topology.triangle_edges.size() != triangles || r.locked.size() != edges ||
        r.vertices.size() + at(r.base_vertices) != vertices ||
        cloth.material_positions.size() != vertices || cloth.rest_areas.size() != vertices ||
        r.frozen.size() != at(r.base_triangles)) {
        return "array sizes";
    }
    const Index euler =
        cloth.vertex_count - static_cast<Index>(edges) + static_cast<Index>(triangles);
    if (euler != r.base_vertices - r.base_edges + r.base_triangles) {
        return fmt::format("Euler number {}", euler);
    }
    return "";
}

bool is_same_edge(MeshEdge a, const MeshEdge& b) {
    if (a.v != b.v) {
        std::swap(a.v[0], a.v[1]);
        std::swap(a.triangle[0], a.triangle[1]);
        std::swap(a.apex[0], a.apex[1]);
    }
    return a.v == b.v && a.triangle == b.triangle && a.apex == b.apex;
}

std::string edges_problem(const Cloth& cloth) {
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        for (const Index v : cloth.triangles[t]) {
            if (v < 0 || v >= cloth.vertex_count) {
                return fmt::format("triangle {} has vertex {}", t, v);
            }
        }
    }
    const EdgeTopology built = build_edges(cloth.triangles);
    if (built.edges.size() != cloth.topology.edges.size()) {
        return fmt::format("{} edges, not {}", cloth.topology.edges.size(), built.edges.size());
    }
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index e = cloth.topology.triangle_edges[t][k];
            if (!is_same_edge(cloth.topology.edges[at(e)],
                              built.edges[at(built.triangle_edges[t][k])])) {
                return fmt::format("edge {} of triangle {} at corner {}", e, t, k);
            }
        }
    }
    return "";
}

/// A triangle's generation against that of the vertex it was made about.
std::string triangle_problem(const Cloth& cloth, std::size_t t) {
    const Refinement& r = cloth.refinement;
    const TriangleLevel& level = r.triangles[t];
    if (level.generation == 0) {
        return t < at(r.base_triangles) && level.parts == 0
                   ? ""
                   : fmt::format("triangle {} is not where it was imported", t);
    }
    const Index apex = cloth.triangles[t][0];
    if (!r.is_inserted(apex)) {
        return fmt::format("triangle {} of generation {} has apex {}", t, level.generation, apex);
    }
    const int after = level.generation - r.inserted(apex).generation;
    const bool is_right = level.generation % 2 != 0 ? after == 0 : after == 1 || after == 3;
    return is_right ? ""
                    : fmt::format("triangle {} of generation {} about a vertex of {}", t,
                                  level.generation, r.inserted(apex).generation);
}

std::string edge_problem(const Cloth& cloth, Index e) {
    const Refinement& r = cloth.refinement;
    const MeshEdge& edge = cloth.topology.edges[at(e)];
    if (edge.is_boundary()) {
        return "";
    }
    const auto [A, B] = edge.triangle;
    const std::size_t in_A = corner_opposite(cloth.topology, A, e);
    const std::size_t in_B = corner_opposite(cloth.topology, B, e);
    const int finer = r.triangles[at(A)].generation - r.triangles[at(B)].generation;
    if (std::abs(finer) > 2) {
        return fmt::format("edge {} between generations {} apart", e, finer);
    }
    if (r.locked[at(e)]) {
        return "";
    }
    const double length = rest_edge_length(cloth.rest[at(A)], static_cast<int>(in_A));
    const double other = rest_edge_length(cloth.rest[at(B)], static_cast<int>(in_B));
    if (std::abs(length - other) > k_two_lengths * length) {
        return fmt::format("edge {} of rest lengths {} and {}", e, length, other);
    }
    const auto is_mate_edge = [&](Index t, std::size_t corner) {
        return r.triangles[at(t)].generation % 2 != 0 && corner == 0;
    };
    const bool are_equal = is_mate_edge(A, in_A) && is_mate_edge(B, in_B) && finer == 0;
    const bool waits =
        are_equal &&
        flip_rest(cloth.rest[at(A)], cloth.rest[at(B)]).least_fraction >= k_least_flip_fraction;
    if (waits != std::binary_search(r.pending_flips.begin(), r.pending_flips.end(), e)) {
        return fmt::format("edge {} {} wait for its flip", e, waits ? "does not" : "need not");
    }
    if (!are_equal &&
        ((is_mate_edge(A, in_A) && finer < 1) || (is_mate_edge(B, in_B) && finer > -1))) {
        return fmt::format("mates at edge {} are {} generations apart", e, finer);
    }
    return "";
}

std::string vertex_problem(const Cloth& cloth, Index v) {
    const Refinement& r = cloth.refinement;
    const InsertedVertex& record = r.inserted(v);
    if (record.anchor < 0 || record.anchor >= r.base_vertices || record.generation % 2 == 0) {
        return fmt::format("record of vertex {}", v);
    }
    const bool is_single = record.insertion == Insertion::Centre;
    if (is_single != (record.partner == k_no_index) ||
        (!is_single && (!r.is_inserted(record.partner) || record.partner >= cloth.vertex_count ||
                        r.inserted(record.partner).partner != v))) {
        return fmt::format("partner of vertex {}", v);
    }
    return "";
}

std::string rest_problem(const Cloth& cloth) {
    std::vector<double> areas(at(cloth.vertex_count), 0.0);
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        const RestTriangle& rest = cloth.rest[t];
        const double area = 0.5 / rest.inverse_edges.determinant();
        if (!(rest.area > 0.0) || std::abs(area - rest.area) > k_rounding * rest.area) {
            return fmt::format("triangle {} has a rest area of {}, of its edges {}", t, rest.area,
                               area);
        }
        const auto corner_areas = mixed_corner_areas(rest_corners(rest));
        for (std::size_t k = 0; k < 3; ++k) {
            areas[at(cloth.triangles[t][k])] += corner_areas[k];
        }
    }
    for (std::size_t v = 0; v < areas.size(); ++v) {
        if (std::abs(areas[v] - cloth.rest_areas[v]) > k_rounding * areas[v]) {
            return fmt::format("vertex {} has {} of the rest area {}", v, cloth.rest_areas[v],
                               areas[v]);
        }
    }
    return "";
}

} // namespace

std::string check_refinement(const Cloth& cloth) {
    std::string problem = sizes_problem(cloth);
    if (problem.empty()) {
        problem = edges_problem(cloth);
    }
    for (std::size_t t = 0; t < cloth.triangles.size() && problem.empty(); ++t) {
        problem = triangle_problem(cloth, t);
    }
    for (Index e = 0; at(e) < cloth.topology.edges.size() && problem.empty(); ++e) {
        problem = edge_problem(cloth, e);
    }
    for (Index v = cloth.refinement.base_vertices; v < cloth.vertex_count && problem.empty(); ++v) {
        problem = vertex_problem(cloth, v);
    }
    return problem.empty() ? rest_problem(cloth) : problem;
}

} // namespace weft
