#include "collide/impact.h"

#include "base/parallel.h"

namespace weft {

namespace {

/// False when the bounds of what the sides sweep show that they stay further apart than `reach`.
bool may_meet(PairKind kind, const PairPoints& start, const PairPoints& motion, double reach) {
    const std::size_t split = first_side(kind);
    for (Eigen::Index k = 0; k < 3; ++k) {
        std::array<double, 2> low{Box::k_empty, Box::k_empty};
        std::array<double, 2> high{-Box::k_empty, -Box::k_empty};
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t side = i < split ? 0 : 1;
            const double from = start[i][k];
            const double to = from + motion[i][k];
            low[side] = std::min({low[side], from, to});
            high[side] = std::max({high[side], from, to});
        }
        if (low[0] > high[1] + reach || low[1] > high[0] + reach) {
            return false;
        }
    }
    return true;
}

} // namespace

void ImpactSearch::find(const ContactSurface& surface,
                        std::span<const Candidate> candidates,
                        std::span<const char> look,
                        double dt,
                        const ImpactLimit& limit,
                        std::vector<Impact>& impacts) {
    impacts.clear();
    const auto look_at = [&](std::size_t i, std::vector<Impact>& found) {
        const auto& v = candidates[i].vertices;
        if (!look[at(v[0])] && !look[at(v[1])] && !look[at(v[2])] && !look[at(v[3])]) {
            return;
        }
        const double thickness = surface.thickness_of(v, candidates[i].kind);
        const PairPoints x = start_points(surface, v);
        const PairPoints motion = displacements(surface, v, dt);
        const ApproachLimit nearest{limit.thickness_fraction * thickness, limit.start_fraction};
        // Beyond the limit itself, the space that rounding needs.
        if (!may_meet(candidates[i].kind, x, motion, 1.01 * nearest.distance)) {
            return;
        }
        const auto toi = time_of_impact(candidates[i].kind, x, motion, nearest);
        if (toi && (*toi > 0.0 || separation(candidates[i].kind, x).distance > 0.0)) {
            found.push_back({static_cast<Index>(i), *toi});
        }
    };
    parallel_collect(candidates.size(), look_at, chunks_, impacts);
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
