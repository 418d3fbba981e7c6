#include "step/constrained_vertices.h"

#include "base/parallel.h"

namespace weft {

namespace {

/// A substep that ends this much (s) after a release is still constrained: times are rounded sums.
constexpr double k_release_slack = 1e-9;

} // namespace

void find_constrained(const World& world, double end_time, ConstrainedVertices& constrained) {
    constrained.flags.assign(world.vertex_count(), 0);
    constrained.targets.assign(world.vertex_count(), Vec3::Zero());
    parallel_for(world.pins.size(), [&](std::size_t p) {
        const Pin& pin = world.pins[p];
        const PinGroup& group = world.pin_groups[static_cast<std::size_t>(pin.group)];
        if (end_time > group.until + k_release_slack) {
            return;
        }
        const auto v = static_cast<std::size_t>(pin.vertex);
        constrained.flags[v] = 1;
        constrained.targets[v] = pin_position(pin, group, world.obstacles, end_time);
    });
}

} // namespace weft
