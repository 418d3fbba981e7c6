#include "collide/impact.h"

#include "base/parallel.h"

namespace weft {

namespace {

constexpr std::size_t k_chunk_candidates = 512;

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

} // namespace

void ImpactSearch::find(const ContactSurface& surface,
                        std::span<const Candidate> candidates,
                        std::span<const char> look,
                        double dt,
                        const ImpactLimit& limit,
                        std::vector<Impact>& impacts) {
    const std::size_t chunks = (candidates.size() + k_chunk_candidates - 1) / k_chunk_candidates;
    found_.resize(std::max(found_.size(), chunks));
    const auto look_at = [&](std::size_t i, std::vector<Impact>& out) {
        const auto& v = candidates[i].vertices;
        if (!look[at(v[0])] && !look[at(v[1])] && !look[at(v[2])] && !look[at(v[3])]) {
            return;
        }
        const double thickness = surface.rules[at(candidates[i].rule)].thickness;
        const PairPoints x = start_points(surface, v);
        const auto toi = time_of_impact(candidates[i].kind, x, displacements(surface, v, dt),
                                        {limit.thickness_share * thickness, limit.start_share});
        if (toi && (*toi > 0.0 || separation(candidates[i].kind, x).distance > 0.0)) {
            out.push_back({static_cast<Index>(i), *toi});
        }
    };
    parallel_chunks(
        candidates.size(),
        [&](std::size_t begin, std::size_t end) {
            auto& out = found_[begin / k_chunk_candidates];
            out.clear();
            for (std::size_t i = begin; i < end; ++i) {
                look_at(i, out);
            }
        },
        k_chunk_candidates);
    impacts.clear();
    for (std::size_t c = 0; c < chunks; ++c) {
        impacts.insert(impacts.end(), found_[c].begin(), found_[c].end());
    }
}

ContactRow
make_impact_row(const ContactSurface& surface, const Candidate& candidate, double toi, double dt) {
    PairPoints x = start_points(surface, candidate.vertices);
    const PairPoints motion = displacements(surface, candidate.vertices, dt);
    for (std::size_t i = 0; i < 4; ++i) {
        x[i] += toi * motion[i];
    }
    ContactRow row = make_row(surface, candidate, separation(candidate.kind, x), dt);
    row.least_speed = std::min(row.least_speed, 0.0);
    return row;
}

} // namespace weft
