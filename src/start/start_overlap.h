#pragma once

#include "collide/crossings.h"
#include "scene/params.h"

#include <functional>
#include <optional>
#include <span>

namespace weft {

/// What curing an overlap at the start took.
struct StartOverlapReport {
    std::size_t pairs_before = 0;  ///< triangles that cross
    int rounds = 0;                ///< rounds of untangling
    double max_displacement = 0.0; ///< that a vertex of cloth was moved, m
    double deepest_inset = 0.0;    ///< by which an obstacle's vertex started shrunken, m
    int preroll_substeps = 0;      ///< simulated while obstacles grew
};

/// Pairs of triangles that cross at world.time and that contact would have to keep apart: none when
/// contact is off, and none between cloths when it leaves those alone; sorted.
std::vector<UnresolvedPair> crossings_of_contact(const World& world, const ContactParams& contact);

/// One line for the user: how many pairs cross, the first of them and where.
std::string describe_crossings(const World& world, std::span<const UnresolvedPair> pairs);

/// Takes a world at its start out of crossings as contact.start_overlap asks; pins then hold their
/// vertices, and follow, from where these are. Velocities stay; rest shapes stay the imported ones.
/// Nothing when should_stop (asked now and then) returned true; the world is then to be thrown
/// away.
///
/// Throws Error (BadInput) naming the number of pairs, the first ones and the place when
/// start_overlap is "error" and anything crosses, or when something is left crossing.
std::optional<StartOverlapReport>
cure_start_overlap(World& world, const Scene& scene, const std::function<bool()>& should_stop);

} // namespace weft
