#include "support/contact_world.h"

namespace weft::test {

ContactReport contact_step(World& world, ContactSolver& solver, double dt) {
    const std::vector<char> held(world.vertex_count(), 0);
    std::vector<Contact> contacts;
    solver.find_contacts(world, held, dt, contacts);
    for (Vec3& v : world.velocities) {
        v += dt * Vec3(0.0, -9.81, 0.0);
    }
    const ContactReport report = solver.resolve(world, world.velocities, held, dt, contacts);
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        world.positions[i] += dt * world.velocities[i];
    }
    world.time += dt;
    return report;
}

} // namespace weft::test
