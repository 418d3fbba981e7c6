#pragma once

#include "state/world.h"

#include <limits>
#include <span>

namespace weft {

struct Candidate;
struct ContactSurface;
struct Impact;

/// Two triangles of a ContactSurface by number.
using TrianglePair = std::array<Index, 2>;

/// What is wrong with a pair of triangles.
enum class PairFault {
    Crossing, ///< its triangles cross
    TooNear,  ///< nearer than continuous detection allows
    Pinched,  ///< obstacles leave it no space
};

/// Two triangles of a world that cross, or that contact could not keep apart.
struct UnresolvedPair {
    std::array<ObjectId, 2> objects{};
    std::array<Index, 2> triangles{}; ///< in these objects
    Vec3 place = Vec3::Zero();        ///< where they meet, m
    PairFault fault = PairFault::Crossing;
    double time = 0.0; ///< when it was found: at the end of a substep, s
};

/// What contact did in one substep.
struct ContactReport {
    int contacts_obstacle = 0; ///< pairs of cloth and obstacle that pushed each other
    int contacts_self = 0;     ///< pairs of cloth and cloth that pushed each other
    int impacts = 0;           ///< pairs that continuous detection found after the solve
    int zones = 0;             ///< impact zones that impulses could not resolve
    int scaled_zones = 0;      ///< impact zones whose motion was scaled down, the fail-safe
    bool was_clean = true;     ///< nothing crossed when the substep started
    int unresolved = 0;        ///< pairs that cross, or would, after all stages
    std::vector<UnresolvedPair> pairs{}; ///< the unresolved ones, as far as they are known
    /// Least distance after the substep of the pairs that were looked at, m.
    double min_gap = std::numeric_limits<double>::infinity();
    double seconds_broad = 0.0, seconds_proximity = 0.0, seconds_impact = 0.0;
};

/// Appends what was found at `time` (s).
void add_unresolved(std::vector<UnresolvedPair>& all,
                    double time,
                    std::span<const UnresolvedPair> found);

/// Sorts them by objects, triangles and fault, and keeps the last one of those that tell the same
/// of one pair.
void keep_last_of_each(std::vector<UnresolvedPair>& pairs);

/// What is told of two triangles of the surface that cross at `positions` (#V of the surface, m).
UnresolvedPair describe_crossing(const ContactSurface& surface,
                                 std::span<const Vec3> positions,
                                 const TrianglePair& pair);

/// What is told of pairs that still meet after all stages: they are too near, or pinched where
/// obstacles push a cloth from opposite sides; sorted, each pair of triangles once.
/// @param ends #V of the surface: positions after the substep, m
std::vector<UnresolvedPair> describe_unresolved(const ContactSurface& surface,
                                                std::span<const Candidate> candidates,
                                                std::span<const Impact> unresolved,
                                                std::span<const Vec3> ends);

} // namespace weft
