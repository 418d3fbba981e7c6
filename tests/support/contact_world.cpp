#include "support/contact_world.h"

namespace weft::test {

namespace {

void add_spring_impulses(World& world, const Cloth& cloth, double stiffness, double dt) {
    for (const MeshEdge& edge : cloth.topology.edges) {
        const auto a = static_cast<std::size_t>(cloth.first_vertex + edge.v[0]);
        const auto b = static_cast<std::size_t>(cloth.first_vertex + edge.v[1]);
        const auto& rest = cloth.material_positions;
        const double length =
            (rest[static_cast<std::size_t>(edge.v[1])] - rest[static_cast<std::size_t>(edge.v[0])])
                .norm();
        const Vec3 d = world.positions[b] - world.positions[a];
        const Vec3 n = d.normalized();
        const double damping = 0.5 * std::sqrt(stiffness * world.masses[a]);
        const double tension = stiffness * (d.norm() - length) +
                               damping * n.dot(world.velocities[b] - world.velocities[a]);
        world.velocities[a] += dt * tension / world.masses[a] * n;
        world.velocities[b] -= dt * tension / world.masses[b] * n;
    }
}

} // namespace

ContactReport step(World& world, ContactSolver& solver, double dt, const StepForces& forces) {
    for (Vec3& v : world.velocities) {
        v += dt * forces.gravity;
    }
    if (forces.spring > 0.0) {
        for (const Cloth& cloth : world.cloths) {
            add_spring_impulses(world, cloth, forces.spring, dt);
        }
    }
    const std::vector<char> held(world.vertex_count(), 0);
    const ContactReport report = solver.resolve(world, world.velocities, held, dt);
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        world.positions[i] += dt * world.velocities[i];
    }
    world.time += dt;
    return report;
}

} // namespace weft::test
