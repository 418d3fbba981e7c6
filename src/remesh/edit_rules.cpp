#include "remesh/edit_rules.h"

#include "geometry/dihedral.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {

namespace {

/// A flip across a deeper fold (rad) waits until it is shallower: the rest shape is flat, and the
/// new triangles would be shorter across the fold than they rest, and stretched along it, by a few
/// percent at this angle and by half in slivers at a right angle.
constexpr double k_deep_fold = 20.0 * std::numbers::pi / 180.0;

/// The same where a vertex is held, by contact for example, and cannot give way (see
/// absorb_gain.h).
constexpr double k_deep_held_fold = 8.0 * std::numbers::pi / 180.0;

bool is_free(const StateTransfer& transfer, const EdgeFlip& flip) {
    return transfer.is_free(flip.edge[0]) && transfer.is_free(flip.edge[1]) &&
           transfer.is_free(flip.apex[0]) && transfer.is_free(flip.apex[1]);
}

/// Are the folds across the edge that a flip takes away and across the one that it puts in shallow?
/// The second is the deeper one where a flip is taken back: to the long edge of flat triangles.
bool is_shallow(const StateTransfer& transfer, const EdgeFlip& flip) {
    const Vec3& a = transfer.position(flip.edge[0]);
    const Vec3& b = transfer.position(flip.edge[1]);
    const Vec3& p = transfer.position(flip.apex[0]);
    const Vec3& q = transfer.position(flip.apex[1]);
    const double deepest = is_free(transfer, flip) ? k_deep_fold : k_deep_held_fold;
    return std::abs(dihedral_angle(a, b, p, q)) < deepest &&
           std::abs(dihedral_angle(p, q, b, a)) < deepest;
}

} // namespace

void add_guard(AdaptationHooks& hooks,
               const StateTransfer& transfer,
               EditGuard* guard,
               std::size_t cloth) {
    const auto may_sweep = [&transfer, guard, cloth](const std::array<Index, 4>& v) {
        return guard == nullptr ||
               guard->may_sweep(static_cast<Index>(cloth),
                                {transfer.position(v[0]), transfer.position(v[1]),
                                 transfer.position(v[2]), transfer.position(v[3])},
                                v);
    };
    const auto may_flip = [may_sweep, &transfer](const EdgeFlip& flip) {
        return is_shallow(transfer, flip) &&
               may_sweep({flip.edge[0], flip.edge[1], flip.apex[0], flip.apex[1]});
    };
    hooks.may_flip = may_flip;
    hooks.may_remove = [may_flip, may_sweep](const Removal& removal) {
        bool may = std::all_of(removal.flips.begin(), removal.flips.end(), may_flip);
        for (const VertexParents& gone : removal.vertices) {
            for (const Triangle& left : removal.merged) {
                may = may && may_sweep({gone.vertex, left[0], left[1], left[2]});
            }
        }
        return may;
    };
}

void forbid_moves(AdaptationHooks& hooks) {
    hooks.may_flip = [](const EdgeFlip&) { return false; };
    hooks.may_remove = [](const Removal&) { return false; };
}

} // namespace weft
