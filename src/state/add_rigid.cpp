#include "base/error.h"
#include "geometry/crossing.h"
#include "geometry/mesh_measure.h"
#include "state/build_world.h"
#include "state/rigid_motion.h"

#include <numbers>

namespace weft {

namespace {

/// Stiffness of the springs that hold a body of 1 kg together, N/m. In a substep of 5 ms they are
/// 10^4 times as stiff as its inertia: under a load of a thousand times its weight it gives way by
/// micrometres, which the end of the substep takes back. Smaller: bodies seem soft; larger: single
/// precision spoils the preconditioner.
constexpr double k_stiffness_per_mass = 1e8;

/// Each body is at least as stiff as one with this fraction of the heaviest's mass, as that may lie
/// on it.
/// Smaller: a light body under a heavy one gives way again and again and never rests; larger: see
/// above.
constexpr double k_least_mass_fraction = 0.1;

std::string place_of(const Vec3& x) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", x.x(), x.y(), x.z());
}

void refuse_unless_closed(const RigidParams& params,
                          const TriangleMesh& mesh,
                          const EdgeTopology& topology) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const MeshEdge& edge =
                topology.edges[static_cast<std::size_t>(topology.triangle_edges[t][k])];
            if (edge.triangle[1] == k_no_index) {
                const Vec3& x =
                    mesh.positions[static_cast<std::size_t>(mesh.triangles[t][(k + 1) % 3])];
                fail_input("rigid '{}': {}: is open beside triangle {}, at {}: a rigid body needs "
                           "a closed mesh",
                           params.name, params.mesh.file, t, place_of(x));
            }
        }
    }
    const auto crossings = find_self_crossings(mesh);
    if (!crossings.empty()) {
        const Triangle& triangle = mesh.triangles[static_cast<std::size_t>(crossings[0][0])];
        fail_input("rigid '{}': {}: crosses itself: triangles {} and {}, at {}; {} pairs in all",
                   params.name, params.mesh.file, crossings[0][0], crossings[0][1],
                   place_of(mesh.positions[static_cast<std::size_t>(triangle[0])]),
                   crossings.size());
    }
}

/// Outwards, whichever way the file has them.
void turn_outwards(TriangleMesh& mesh) {
    if (mass_moments(mesh).volume < 0.0) {
        for (Triangle& t : mesh.triangles) {
            std::swap(t[1], t[2]);
        }
    }
}

void stiffen(World& world) {
    double heaviest = 0.0;
    for (const RigidBody& rigid : world.rigids) {
        heaviest = std::max(heaviest, rigid.params.mass);
    }
    for (RigidBody& rigid : world.rigids) {
        rigid.stiffness =
            k_stiffness_per_mass * std::max(rigid.params.mass, k_least_mass_fraction * heaviest);
    }
}

void append(World& world, const Vec3& position, const Vec3& velocity, double mass) {
    world.positions.push_back(position);
    world.velocities.push_back(velocity);
    world.masses.push_back(mass);
}

} // namespace

RigidBody& add_rigid(World& world, const RigidParams& params, const ImportedMesh& imported) {
    TriangleMesh mesh = imported.mesh;
    for (Vec3& x : mesh.positions) {
        x = place(params.placement, x);
    }
    refuse_unless_closed(params, mesh, build_edges(mesh.triangles));
    turn_outwards(mesh);
    const MassMoments moments = mass_moments(mesh);

    RigidBody rigid;
    rigid.params = params;
    rigid.rest = particles_with(moments.second);
    Body& body = rigid.body;
    body.name = params.name;
    body.first_vertex = static_cast<Index>(world.vertex_count());
    body.vertex_count = static_cast<Index>(mesh.positions.size());
    body.first_particle = body.first_vertex + body.vertex_count;
    body.particle_count = 4;
    body.topology = build_edges(mesh.triangles);
    body.thickness = params.thickness;
    body.friction = params.friction;
    body.static_friction = params.static_friction.value_or(params.friction);
    body.touches_itself = false;
    for (const Vec3& x : mesh.positions) {
        body.embeddings.push_back(
            {{0, 1, 2, 3}, embedding_weights(rigid.rest, x - moments.centre)});
        append(world, x, params.velocity, 0.0);
    }
    const Vec3 turning = params.spin_deg * (std::numbers::pi / 180.0);
    for (const Vec3& arm : rigid.rest) {
        append(world, moments.centre + arm, params.velocity + turning.cross(arm),
               0.25 * params.mass);
    }
    body.triangles = std::move(mesh.triangles);
    interpolate_embedded(body, world.positions);
    interpolate_embedded(body, world.velocities);
    extend_history(world);
    world.rigids.push_back(std::move(rigid));
    stiffen(world);
    return world.rigids.back();
}

} // namespace weft
