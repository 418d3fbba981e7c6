#include "state/seam_chain.h"

#include "base/error.h"

#include <algorithm>
#include <map>

namespace weft {

namespace {

/// Fraction of a segment by which a match may be moved to make it a vertex. Smaller: equal borders
/// that are cut a little differently are tied crosswise; larger: fractions of the length differ.
constexpr double k_snap = 0.1;

/// Chains with equally many vertices are joined one by one when these are apart by less than this
/// fraction of a segment.
constexpr double k_one_by_one = 0.5;

/// Rest length between two vertices: of their edge, or the distance at the start without one.
class EdgeLengths {
public:
    EdgeLengths(const Cloth& cloth, std::span<const Vec3> positions) : positions_(positions) {
        for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Triangle& v = cloth.triangles[t];
                lengths_[std::minmax(v[(k + 1) % 3], v[(k + 2) % 3])] =
                    rest_edge_length(cloth.rest[t], static_cast<int>(k));
            }
        }
    }
    double operator()(Index a, Index b) const {
        const auto found = lengths_.find(std::minmax(a, b));
        return found != lengths_.end() ? found->second
                                       : (positions_[at(a)] - positions_[at(b)]).norm();
    }

private:
    std::map<std::pair<Index, Index>, double> lengths_;
    std::span<const Vec3> positions_;
};

SeamChain measured(std::vector<Index> vertices, const EdgeLengths& length) {
    SeamChain chain{std::move(vertices), {0.0}};
    for (std::size_t i = 1; i < chain.vertices.size(); ++i) {
        chain.along.push_back(chain.along.back() +
                              length(chain.vertices[i - 1], chain.vertices[i]));
    }
    return chain;
}

void require_vertex(const Cloth& cloth, Index v, const std::string& place) {
    if (v >= cloth.vertex_count) {
        fail_input("{}: {}: must be 0 to {} (vertices after welding)", place, v,
                   cloth.vertex_count - 1);
    }
}

/// Borders of a cloth, and where a chosen vertex stands on them.
struct Border {
    std::vector<std::vector<Index>> loops;

    struct Spot {
        std::size_t loop, place;
    };
    Spot find(const VertexChoice& choice,
              double radius,
              const std::string& place,
              std::span<const Vec3> positions) const {
        Spot spot{loops.size(), 0};
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t l = 0; l < loops.size(); ++l) {
            for (std::size_t i = 0; i < loops[l].size(); ++i) {
                const Index v = loops[l][i];
                const double distance = choice.vertex != k_no_index
                                            ? (v == choice.vertex ? 0.0 : 2.0 * radius)
                                            : (positions[at(v)] - choice.place).norm();
                if (distance < nearest && distance <= radius) {
                    nearest = distance;
                    spot = {l, i};
                }
            }
        }
        if (spot.loop == loops.size()) {
            const Vec3& x = choice.place;
            const std::string what =
                choice.vertex != k_no_index
                    ? fmt::format("{}: must be a vertex on the border", choice.vertex)
                    : fmt::format("({:.4g}, {:.4g}, {:.4g}) m: must be within radius, {} m, of a "
                                  "border vertex",
                                  x.x(), x.y(), x.z(), radius);
            fail_input("{} = {}", place, what);
        }
        return spot;
    }
};

/// The vertices of a loop from one place to another, forwards or backwards.
std::vector<Index>
path(const std::vector<Index>& loop, std::size_t from, std::size_t to, bool forwards) {
    std::vector<Index> vertices{loop[from]};
    const std::size_t step = forwards ? 1 : loop.size() - 1;
    for (std::size_t i = from; i != to;) {
        i = (i + step) % loop.size();
        vertices.push_back(loop[i]);
    }
    return vertices;
}

} // namespace

SeamChain build_seam_chain(const Cloth& cloth,
                           const AttachSide& side,
                           double radius,
                           const std::string& place,
                           std::span<const Vec3> positions) {
    const EdgeLengths length(cloth, positions);
    for (const Index v : side.vertices) {
        require_vertex(cloth, v, place + ".vertices");
    }
    if (!side.vertices.empty()) {
        return measured(side.vertices, length);
    }
    const Border border{boundary_loops(cloth.topology)};
    const auto find = [&](const VertexChoice& choice, const char* key) {
        require_vertex(cloth, choice.vertex, place + key);
        return border.find(choice, radius, place + key, positions);
    };
    const Border::Spot from = find(*side.from, ".from");
    const Border::Spot to = find(*side.to, ".to");
    const auto& loop = border.loops[from.loop];
    if (to.loop != from.loop || to.place == from.place) {
        fail_input("{}: from and to: must be two vertices of one border, and are {}", place,
                   to.loop != from.loop ? "on two" : "the same vertex");
    }
    SeamChain one = measured(path(loop, from.place, to.place, true), length);
    SeamChain other = measured(path(loop, from.place, to.place, false), length);
    if (side.via) {
        const Border::Spot via = find(*side.via, ".via");
        const Index v = border.loops[via.loop][via.place];
        const bool on_one =
            std::find(one.vertices.begin(), one.vertices.end(), v) != one.vertices.end();
        if (via.loop != from.loop) {
            fail_input("{}.via: must be on the border of from and to", place);
        }
        return on_one ? one : other;
    }
    return one.length() <= other.length() ? one : other;
}

std::vector<SeamMatch> match_chains(const SeamChain& fine, const SeamChain& coarse) {
    const double scale = coarse.length() / fine.length();
    std::vector<SeamMatch> matches;
    double furthest = 0.0; // between vertices with the same number, in segments
    for (std::size_t i = 0; i < fine.along.size(); ++i) {
        const double place = std::min(scale * fine.along[i], coarse.length());
        const auto above =
            std::upper_bound(coarse.along.begin() + 1, coarse.along.end() - 1, place);
        const auto segment = static_cast<std::size_t>(above - coarse.along.begin()) - 1;
        const double length = coarse.along[segment + 1] - coarse.along[segment];
        double weight =
            length > 0.0 ? std::clamp((place - coarse.along[segment]) / length, 0.0, 1.0) : 0.0;
        if (i < coarse.along.size() && length > 0.0) {
            furthest = std::max(furthest, std::abs(place - coarse.along[i]) / length);
        }
        weight = weight < k_snap ? 0.0 : weight > 1.0 - k_snap ? 1.0 : weight;
        matches.push_back({i, segment, weight});
    }
    if (fine.along.size() == coarse.along.size() && furthest < k_one_by_one) {
        for (std::size_t i = 0; i < matches.size(); ++i) {
            const std::size_t segment = std::min(i, coarse.along.size() - 2);
            matches[i] = {i, segment, i == segment ? 0.0 : 1.0};
        }
    }
    return matches;
}

} // namespace weft
