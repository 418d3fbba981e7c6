#include "step/held.h"

#include "base/parallel.h"

namespace weft {

namespace {

/// A substep that ends this much (s) after a release still holds: times are sums of rounded shares.
constexpr double k_release_slack = 1e-9;

} // namespace

void find_held(const World& world, double end_time, HeldVertices& held) {
    held.flags.assign(world.vertex_count(), 0);
    held.targets.assign(world.vertex_count(), Vec3::Zero());
    parallel_for(world.pins.size(), [&](std::size_t p) {
        const Pin& pin = world.pins[p];
        const PinGroup& group = world.pin_groups[static_cast<std::size_t>(pin.group)];
        if (end_time > group.until + k_release_slack) {
            return;
        }
        const auto v = static_cast<std::size_t>(pin.vertex);
        held.flags[v] = 1;
        held.targets[v] = pin_position(pin, group, world.obstacles, end_time);
    });
}

} // namespace weft
