#include "step/recovery.h"

#include "base/parallel.h"
#include "collide/untangle.h"

namespace weft {

bool recover_from_crossings(World& world) {
    const std::vector<Vec3> tangled = world.positions;
    const UntangleReport report = untangle(world);
    if (report.pairs_after > 0) {
        world.positions = tangled;
        return false;
    }
    for (const Pin& pin : world.pins) { // a pinned vertex stays
        const auto v = static_cast<std::size_t>(pin.vertex);
        world.positions[v] = tangled[v];
    }
    parallel_for(tangled.size(), [&](std::size_t v) {
        world.previous_positions[v] += world.positions[v] - tangled[v];
    });
    return true;
}

} // namespace weft
