#include "collide/left_pairs.h"

#include <algorithm>
#include <tuple>

namespace weft {

namespace {

/// Two pushes oppose each other where the cosine between them is below this.
constexpr double k_opposed = -0.2;

/// A pair with what its sides look like at the end.
struct LeftPair {
    const Candidate* candidate;
    Vec3 place; ///< on side 2, m
    Vec3 push;  ///< on the deformable of a pair with an obstacle, unit; else zero
};

LeftPair measure(const ContactSurface& surface, const Candidate& c, std::span<const Vec3> ends) {
    PairPoints x;
    for (std::size_t k = 0; k < 4; ++k) {
        x[k] = ends[at(c.vertices[k])];
    }
    const Separation s = separation(c.kind, x);
    LeftPair left{&c, Vec3::Zero(), Vec3::Zero()};
    for (std::size_t k = first_side(c.kind); k < 4; ++k) {
        left.place -= s.weights[k] * x[k];
    }
    const bool first = surface.is_deformable(c.vertices[0]);
    if (first != surface.is_deformable(c.vertices[3])) {
        left.push = first ? s.normal : Vec3(-s.normal);
    }
    return left;
}

/// The pushes that obstacles exert on each vertex of a deformable and on its neighbours.
class Pushes {
public:
    explicit Pushes(const ContactSurface& surface)
        : surface_(surface), of_vertex_(at(surface.deformable_vertices)) {}

    void add(const LeftPair& left) {
        for (const Index v : left.candidate->vertices) {
            if (surface_.is_deformable(v) && !left.push.isZero()) {
                of_vertex_[at(v)].push_back(left.push);
            }
        }
    }

    bool oppose(const LeftPair& left) const {
        const auto any_at = [&](Index v) {
            return std::any_of(of_vertex_[at(v)].begin(), of_vertex_[at(v)].end(),
                               [&](const Vec3& push) { return push.dot(left.push) < k_opposed; });
        };
        for (const Index v : left.candidate->vertices) {
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

/// Of each vertex: the triangle that speaks for it; k_no_index where none does.
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

ContactProblem
describe(const ContactSurface& surface, const LeftPair& left, const std::array<Index, 2>& pair) {
    ContactProblem problem{
        .objects{}, .triangles{}, .place = left.place, .kind = ProblemKind::TooNear};
    const std::array<Index, 2> sorted{std::min(pair[0], pair[1]), std::max(pair[0], pair[1])};
    for (std::size_t side = 0; side < 2; ++side) {
        const Index object = surface.object_of_vertex[at(surface.triangles[at(sorted[side])][0])];
        problem.objects[side] = object;
        problem.triangles[side] = sorted[side] - surface.objects[at(object)].first_triangle;
    }
    return problem;
}

} // namespace

std::vector<ContactProblem> describe_left(const ContactSurface& surface,
                                          std::span<const Candidate> candidates,
                                          std::span<const Impact> left,
                                          std::span<const Vec3> ends) {
    if (left.empty()) {
        return {};
    }
    std::vector<LeftPair> pairs;
    Pushes pushes(surface);
    for (const Impact& impact : left) {
        pairs.push_back(measure(surface, candidates[at(impact.candidate)], ends));
        pushes.add(pairs.back());
    }
    const std::vector<Index> speaker = speakers(surface);
    std::vector<ContactProblem> problems;
    for (const LeftPair& pair : pairs) {
        const Candidate& c = *pair.candidate;
        const Index first =
            c.kind == PairKind::VertexFace ? speaker[at(c.vertices[0])] : c.triangles[0];
        if (first == k_no_index) {
            continue; // a loose vertex belongs to no triangle
        }
        problems.push_back(describe(surface, pair, {first, c.triangles[1]}));
        if (!pair.push.isZero() && pushes.oppose(pair)) {
            problems.back().kind = ProblemKind::Pinched;
        }
    }
    const auto key = [](const ContactProblem& p) {
        return std::tie(p.objects, p.triangles, p.kind);
    };
    std::stable_sort(
        problems.begin(), problems.end(),
        [&](const ContactProblem& p, const ContactProblem& q) { return key(p) < key(q); });
    problems.erase(std::unique(problems.begin(), problems.end(),
                               [](const ContactProblem& p, const ContactProblem& q) {
                                   return p.objects == q.objects && p.triangles == q.triangles;
                               }),
                   problems.end());
    return problems;
}

} // namespace weft
