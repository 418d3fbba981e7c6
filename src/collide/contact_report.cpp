#include "collide/contact_report.h"

#include "collide/impact_zones.h"
#include "geometry/crossing.h"

#include <algorithm>
#include <tuple>

namespace weft {

namespace {

auto key_of(const UnresolvedPair& pair) {
    return std::tie(pair.objects, pair.triangles, pair.fault);
}

/// A pair of triangles of the surface by the names that the world has for them.
UnresolvedPair
pair_of(const ContactSurface& surface, const TrianglePair& triangles, const Vec3& place) {
    UnresolvedPair pair{.place = place};
    for (std::size_t side = 0; side < 2; ++side) {
        const Index vertex = surface.triangles[at(triangles[side])][0];
        const ContactObject& object = surface.objects[at(surface.object_of_vertex[at(vertex)])];
        pair.objects[side] = object.id;
        pair.triangles[side] = triangles[side] - object.first_triangle;
    }
    return pair;
}

/// Two pushes oppose each other where the cosine between them is below this.
constexpr double k_opposed = -0.2;

/// A pair that still meets, as it stands at the end.
struct EndState {
    const Candidate* candidate;
    Vec3 place; ///< on side 2, m
    Vec3 push;  ///< on the deformable of a pair with an obstacle, unit; else zero
};

EndState measure(const ContactSurface& surface, const Candidate& c, std::span<const Vec3> ends) {
    PairPoints x;
    for (std::size_t k = 0; k < 4; ++k) {
        x[k] = ends[at(c.vertices[k])];
    }
    const Separation s = separation(c.kind, x);
    EndState end{&c, Vec3::Zero(), Vec3::Zero()};
    for (std::size_t k = first_side(c.kind); k < 4; ++k) {
        end.place -= s.weights[k] * x[k];
    }
    const bool first = surface.is_deformable(c.vertices[0]);
    if (first != surface.is_deformable(c.vertices[3])) {
        end.push = first ? s.normal : Vec3(-s.normal);
    }
    return end;
}

/// The pushes that obstacles exert on each vertex of a deformable and on its neighbours.
class Pushes {
public:
    explicit Pushes(const ContactSurface& surface)
        : surface_(surface), of_vertex_(at(surface.deformable_vertices)) {}

    void add(const EndState& pair) {
        for (const Index v : pair.candidate->vertices) {
            if (surface_.is_deformable(v) && !pair.push.isZero()) {
                of_vertex_[at(v)].push_back(pair.push);
            }
        }
    }

    bool oppose(const EndState& pair) const {
        const auto any_at = [&](Index v) {
            return std::any_of(of_vertex_[at(v)].begin(), of_vertex_[at(v)].end(),
                               [&](const Vec3& push) { return push.dot(pair.push) < k_opposed; });
        };
        for (const Index v : pair.candidate->vertices) {
            if (!surface_.is_deformable(v)) {
                continue;
            }
            const auto ring =
                std::span(surface_.ring)
                    .subspan(at(surface_.ring_begin[at(v)]),
                             at(surface_.ring_begin[at(v) + 1] - surface_.ring_begin[at(v)]));
            if (any_at(v) || std::any_of(ring.begin(), ring.end(), any_at)) {
                return true;
            }
        }
        return false;
    }

private:
    const ContactSurface& surface_;
    std::vector<std::vector<Vec3>> of_vertex_;
};

/// #V: the triangle that speaks for each vertex; k_no_index where none does.
std::vector<Index> speakers(const ContactSurface& surface) {
    std::vector<Index> speaker(surface.start.size(), k_no_index);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (surface.owns_corner(static_cast<Index>(t), k)) {
                speaker[at(surface.triangles[t][k])] = static_cast<Index>(t);
            }
        }
    }
    return speaker;
}

} // namespace

void add_unresolved(std::vector<UnresolvedPair>& all,
                    double time,
                    std::span<const UnresolvedPair> found) {
    for (const UnresolvedPair& pair : found) {
        all.push_back(pair);
        all.back().time = time;
    }
}

void keep_last_of_each(std::vector<UnresolvedPair>& pairs) {
    std::reverse(pairs.begin(), pairs.end());
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const auto& p, const auto& q) { return key_of(p) < key_of(q); });
    const auto same = [](const UnresolvedPair& p, const UnresolvedPair& q) {
        return key_of(p) == key_of(q);
    };
    pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
}

UnresolvedPair describe_crossing(const ContactSurface& surface,
                                 std::span<const Vec3> positions,
                                 const TrianglePair& pair) {
    return pair_of(
        surface, pair,
        crossing_place(surface.triangles[at(pair[0])], surface.triangles[at(pair[1])], positions));
}

std::vector<UnresolvedPair> describe_unresolved(const ContactSurface& surface,
                                                std::span<const Candidate> candidates,
                                                std::span<const Impact> unresolved,
                                                std::span<const Vec3> ends) {
    if (unresolved.empty()) {
        return {};
    }
    std::vector<EndState> states;
    Pushes pushes(surface);
    for (const Impact& impact : unresolved) {
        states.push_back(measure(surface, candidates[at(impact.candidate)], ends));
        pushes.add(states.back());
    }
    const std::vector<Index> speaker = speakers(surface);
    std::vector<UnresolvedPair> pairs;
    for (const EndState& state : states) {
        const Candidate& c = *state.candidate;
        const Index first =
            c.kind == PairKind::VertexFace ? speaker[at(c.vertices[0])] : c.triangles[0];
        if (first == k_no_index) {
            continue; // a loose vertex belongs to no triangle
        }
        const Index second = c.triangles[1];
        pairs.push_back(
            pair_of(surface, {std::min(first, second), std::max(first, second)}, state.place));
        const bool is_pinched = !state.push.isZero() && pushes.oppose(state);
        pairs.back().fault = is_pinched ? PairFault::Pinched : PairFault::TooNear;
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const auto& p, const auto& q) { return key_of(p) < key_of(q); });
    pairs.erase(std::unique(pairs.begin(), pairs.end(),
                            [](const UnresolvedPair& p, const UnresolvedPair& q) {
                                return p.objects == q.objects && p.triangles == q.triangles;
                            }),
                pairs.end());
    return pairs;
}

} // namespace weft
