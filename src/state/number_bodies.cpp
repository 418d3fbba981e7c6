#include "state/number_bodies.h"

namespace weft {

void number_bodies(World& world) {
    Index next = 0;
    if (!world.cloths.empty()) {
        next = world.cloths.back().first_vertex + world.cloths.back().vertex_count;
    }
    const auto number = [&](Body& body) {
        body.first_vertex = next;
        body.first_particle = next + body.vertex_count;
        next += body.vertex_count + body.particle_count;
    };
    for (Solid& solid : world.solids) {
        number(solid.body);
    }
    for (RigidBody& rigid : world.rigids) {
        number(rigid.body);
    }
}

} // namespace weft
