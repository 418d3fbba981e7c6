#pragma once

#include "scene/params.h"
#include "start/start_overlap.h"
#include "step/prepared.h"

/// The one way from a scene to a simulation: build the world, take it out of overlaps, make its
/// cloths adaptive.
namespace weft {

/// A world that is ready, and what that took.
struct Preparation {
    Prepared start;
    StartOverlapReport overlap;
};

/// Prepares a world that has been built of the scene. Returns nothing when should_stop (asked now
/// and then while overlaps are cured) returned true. Throws as cure_start_overlap() does.
std::optional<Preparation>
prepare(World built, const Scene& scene, const std::function<bool()>& should_stop);

/// Builds the world of a scene and prepares it. `warn` receives one line each. Throws as
/// build_world() and cure_start_overlap() do.
Prepared prepare(const Scene& scene, const std::function<void(const std::string&)>& warn);

} // namespace weft
