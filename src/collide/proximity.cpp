#include "collide/proximity.h"

#include "base/parallel.h"

#include <cassert>

namespace weft {

namespace {

/// Sine of the angle by which a connection may lean towards a triangle beside it. Smaller: contacts
/// at shared edges are lost to rounding; larger: what slides far in a substep is lifted, and
/// braked.
constexpr double k_lean = 1e-5;

constexpr std::size_t k_chunk_candidates = 512;

/// False when the bounds of the sides alone show that they are further apart than `reach`.
bool may_be_near(PairKind kind, const PairPoints& x, double reach) {
    for (Eigen::Index k = 0; k < 3; ++k) {
        const bool vertex_face = kind == PairKind::VertexFace;
        const double low1 = vertex_face ? x[0][k] : std::min(x[0][k], x[1][k]);
        const double high1 = vertex_face ? x[0][k] : std::max(x[0][k], x[1][k]);
        const double second = vertex_face ? x[1][k] : x[2][k];
        const double low2 = std::min({x[2][k], x[3][k], second});
        const double high2 = std::max({x[2][k], x[3][k], second});
        if (low1 > high2 + reach || low2 > high1 + reach) {
            return false;
        }
    }
    return true;
}

/// Does `normal` lean towards the triangle on `apex`'s side of the edge (a, b)?
bool leans_to_triangle(
    const ContactSurface& surface, const Vec3& normal, Index a, Index b, Index apex) {
    if (apex == k_no_index) {
        return false;
    }
    const Vec3& origin = surface.start[at(a)];
    const Vec3 edge = surface.start[at(b)] - origin;
    const Vec3 side = surface.start[at(apex)] - origin;
    const double length_squared = edge.squaredNorm();
    const Vec3 inward =
        length_squared > 0.0 ? Vec3(side - edge.dot(side) / length_squared * edge) : side;
    return normal.dot(inward) > k_lean * inward.norm();
}

bool leans_to_ring(const ContactSurface& surface, const Vec3& normal, Index v) {
    for (Index i = surface.ring_begin[at(v)]; i < surface.ring_begin[at(v) + 1]; ++i) {
        const Vec3 along = surface.start[at(surface.ring[at(i)])] - surface.start[at(v)];
        if (normal.dot(along) > k_lean * along.norm()) {
            return true;
        }
    }
    return false;
}

bool vertex_face_is_nearest(const ContactSurface& surface,
                            const Candidate& candidate,
                            const Separation& place) {
    const Index t = candidate.triangles[0];
    const Triangle& corners = surface.triangles[at(t)];
    std::array<bool, 3> used{};
    for (std::size_t k = 0; k < 3; ++k) {
        used[k] = place.weights[k + 1] != 0.0;
    }
    const int count = int(used[0]) + int(used[1]) + int(used[2]);
    if (count == 3) {
        return true;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const Index a = corners[(k + 1) % 3];
        const Index b = corners[(k + 2) % 3];
        if (count == 2 && !used[k]) { // on the side opposite to corner k
            return surface.owns_side(t, k) &&
                   !leans_to_triangle(surface, place.normal, a, b, surface.across[at(t)][k]);
        }
        if (count == 1 && used[k]) {
            return surface.owns_corner(t, k) && !leans_to_ring(surface, place.normal, corners[k]);
        }
    }
    return true;
}

bool leans_beside_edge(
    const ContactSurface& surface, const Vec3& normal, Index t, Index a, Index b) {
    const Triangle& corners = surface.triangles[at(t)];
    for (std::size_t k = 0; k < 3; ++k) {
        if (corners[k] != a && corners[k] != b) {
            return leans_to_triangle(surface, normal, a, b, corners[k]) ||
                   leans_to_triangle(surface, normal, a, b, surface.across[at(t)][k]);
        }
    }
    return false;
}

} // namespace

bool is_nearest_here(const ContactSurface& surface,
                     const Candidate& candidate,
                     const Separation& place) {
    if (place.distance == 0.0) {
        return true;
    }
    if (candidate.kind == PairKind::VertexFace) {
        return vertex_face_is_nearest(surface, candidate, place);
    }
    const auto& w = place.weights;
    if (w[0] == 0.0 || w[1] == 0.0 || w[2] == 0.0 || w[3] == 0.0) {
        return false; // a vertex and an edge: the vertex's pair with a face has it
    }
    const auto& v = candidate.vertices;
    return !leans_beside_edge(surface, -place.normal, candidate.triangles[0], v[0], v[1]) &&
           !leans_beside_edge(surface, place.normal, candidate.triangles[1], v[2], v[3]);
}

std::optional<Separation> near_place(const ContactSurface& surface, const Candidate& candidate) {
    const double reach = k_reach * surface.thickness_of(candidate.vertices, candidate.kind);
    const PairPoints x = start_points(surface, candidate.vertices);
    if (!may_be_near(candidate.kind, x, reach)) {
        return {};
    }
    const Separation place = separation(candidate.kind, x);
    return place.distance < reach && is_nearest_here(surface, candidate, place)
               ? std::optional(place)
               : std::nullopt;
}

void ProximitySearch::find(const ContactSurface& surface,
                           std::span<const Candidate> candidates,
                           double dt,
                           std::vector<ContactRow>& rows) {
    const std::size_t chunks = (candidates.size() + k_chunk_candidates - 1) / k_chunk_candidates;
    found_.resize(std::max(found_.size(), chunks));
    const auto look_at = [&](const Candidate& candidate, std::vector<ContactRow>& out) {
        if (const auto place = near_place(surface, candidate)) {
            out.push_back(make_row(surface, candidate, *place, dt));
        }
    };
    parallel_chunks(
        candidates.size(),
        [&](std::size_t begin, std::size_t end) {
            auto& out = found_[begin / k_chunk_candidates];
            out.clear();
            for (const Candidate& candidate : candidates.subspan(begin, end - begin)) {
                look_at(candidate, out);
            }
        },
        k_chunk_candidates);
    rows.clear();
    for (std::size_t c = 0; c < chunks; ++c) {
        rows.insert(rows.end(), found_[c].begin(), found_[c].end());
    }
}

} // namespace weft
