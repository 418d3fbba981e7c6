#include "collide/contact_row.h"
#include "collide/contact_solver.h"
#include "collide/crossings.h"
#include "state/rigid_motion.h"
#include "support/contact_world.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

constexpr double k_dt = 0.01;

/// One triangle of a cloth below a vertex of another, 1 mm apart of 2 mm; vertex 0 moves.
struct OneContact {
    World world;
    ContactSurface surface;
    std::vector<ContactRow> rows;
    std::vector<char> touched;

    OneContact(const Vec3& velocity, double friction, double gap = 2e-3) {
        FabricParams fabric;
        fabric.thickness = 2e-3;
        fabric.friction = friction;
        test::add_sheet(world, 1, 0.1, 0.0, fabric);
        test::add_sheet(world, 1, 0.1, 0.0, fabric);
        std::vector<Vec3> velocities(8, Vec3::Zero());
        velocities[0] = velocity;
        surface = make_surface(world);
        place_surface(surface, world, velocities, std::vector<char>(8, 0), k_dt);
        const Triangle face{4, 6, 5};
        surface.start[0] = 0.5 * surface.start[4] + 0.25 * (surface.start[5] + surface.start[6]) +
                           gap * Vec3::UnitY();
        const Candidate candidate{.vertices = {0, face[0], face[1], face[2]},
                                  .triangles = {2, 2},
                                  .rule = surface.rule_of(0, 4),
                                  .kind = PairKind::VertexFace};
        rows.push_back(make_row(
            surface, candidate,
            separation(PairKind::VertexFace, start_points(surface, candidate.vertices)), k_dt));
        touched.assign(8, 0);
        sweep(rows, surface, touched);
    }

    Vec3 relative_velocity() const {
        return surface.velocity[0] - 0.5 * surface.velocity[4] -
               0.25 * (surface.velocity[5] + surface.velocity[6]);
    }
};

} // namespace

TEST(ContactRow, SticksWhileThePushAllowsIt) {
    const OneContact contact({0.29, -1.0, 0.0}, 0.3); // |v_t| < mu dv_n

    EXPECT_LT(contact.relative_velocity().norm(), 1e-12);
}

TEST(ContactRow, SlidesSlowerByFrictionTimesThePushBeyondThat) {
    const OneContact contact({0.6, -1.0, 0.8}, 0.3); // |v_t| = 1

    EXPECT_LT((contact.relative_velocity() - 0.7 * Vec3(0.6, 0.0, 0.8)).norm(), 1e-12);
}

TEST(ContactRow, LetsPartingPairsGo) {
    const OneContact contact({0.5, 1.0, 0.0}, 0.3);

    EXPECT_EQ(contact.surface.velocity[0], Vec3(0.5, 1.0, 0.0));
    EXPECT_EQ(contact.touched, std::vector<char>(8, 0));
}

TEST(ContactRow, PairsBeyondTheirThicknessMayJustReachIt) {
    const OneContact contact({0.0, -1.0, 0.0}, 0.0, 2.4e-3);

    EXPECT_NEAR(contact.relative_velocity().y(), -0.4e-3 / k_dt, 1e-12);
}

TEST(ContactRow, OverlapIsTakenBackByATenthASubstepAtMost) {
    const OneContact contact({0.0, -1.0, 0.0}, 0.0, 1e-3);

    EXPECT_NEAR(contact.relative_velocity().y(), 0.1 * 1e-3 / k_dt, 1e-12);
}

TEST(ContactRow, KeepsMomentumAndAngularMomentum) {
    const OneContact contact({0.6, -1.0, 0.8}, 0.0);
    const auto moment = [&](const std::vector<Vec3>& velocities) {
        Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
        for (std::size_t i = 0; i < 8; ++i) {
            const Vec3 p = contact.world.masses[i] * velocities[i];
            sum.head<3>() += p;
            sum.tail<3>() += contact.surface.start[i].cross(p);
        }
        return sum;
    };
    std::vector<Vec3> before(8, Vec3::Zero());
    before[0] = Vec3(0.6, -1.0, 0.8);

    EXPECT_LT((moment(contact.surface.velocity) - moment(before)).norm(), 1e-17);
}

using namespace test;

namespace {

/// Two boxes in the air, one over the other and turned, a millimetre apart, that fly together.
Scene boxes() {
    Scene scene;
    for (const double height : {0.0, 0.201}) {
        RigidParams box;
        box.name = height == 0.0 ? "lower" : "upper";
        box.shape = Shape::Box;
        box.size = Vec3(0.3, 0.2, 0.25);
        box.mass = height == 0.0 ? 2.0 : 5.0;
        box.placement.translate = Vec3(height, height, 0.0);
        box.placement.rotate_deg = Vec3(0.0, 100.0 * height, 0.0);
        box.velocity = Vec3(0.3, height == 0.0 ? 0.5 : -0.7, 0.1);
        scene.rigids.push_back(box);
    }
    return scene;
}

ContactSurface surface_of(const World& world) {
    ContactSurface surface = make_surface(world);
    place_surface(surface, world, world.velocities, std::vector<char>(world.vertex_count(), 0),
                  0.01);
    return surface;
}

/// Corner of the upper box over a face of the lower one.
constexpr std::array<double, 4> k_weights{1.0, -0.2, -0.5, -0.3};
std::array<Index, 4> pair_of(const World& world) {
    const Body& lower = world.rigids[0].body;
    const Triangle& t = lower.triangles[0];
    return {world.rigids[1].body.first_vertex, lower.first_vertex + t[0], lower.first_vertex + t[1],
            lower.first_vertex + t[2]};
}

Vec3 relative(const ContactSurface& surface, const std::array<Index, 4>& pair) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
        sum += k_weights[i] * velocity_of(surface, pair[i]);
    }
    return sum;
}

} // namespace

TEST(CarriedMotion, AnImpulseChangesTheRelativeVelocityAsThePairsMassSays) {
    const World world = build_quietly(boxes());
    const auto pair = pair_of(world);
    const Vec3 normal = Vec3(0.2, 0.9, -0.3).normalized();
    for (const Vec3& direction : {normal, Vec3(normal.cross(Vec3::UnitX()).normalized())}) {
        ContactSurface surface = surface_of(world);
        std::vector<char> touched(surface.start.size(), 0);
        const PairMass mass = mass_of_pair(surface, pair, k_weights, normal);
        const Vec3 before = relative(surface, pair);

        push_pair(surface, pair, k_weights, 0.4 * direction, touched);

        const double change = direction.dot(relative(surface, pair) - before);
        if (direction == normal) {
            EXPECT_NEAR(change, 0.4 / mass.along, 1e-12);
        } else { // so that friction does not turn the slip round
            EXPECT_GT(change, 0.0);
            EXPECT_LE(change, 0.4 / mass.tangential * (1.0 + 1e-12));
        }
    }
}

TEST(CarriedMotion, AnImpulseLeavesBodiesRigidAndWhatTheyCarryFollows) {
    const World world = build_quietly(boxes());
    ContactSurface surface = surface_of(world);
    std::vector<char> touched(surface.start.size(), 0);

    push_pair(surface, pair_of(world), k_weights, Vec3(0.3, 0.8, -0.2), touched);
    follow_particles(surface, touched);

    std::vector<Vec3> carried = surface.velocity;
    interpolate_embedded(world, carried);
    for (const RigidBody& rigid : world.rigids) {
        const Body& body = rigid.body;
        for (Index i = body.first_vertex; i < body.first_particle + 4; ++i) {
            const auto a = static_cast<std::size_t>(i);
            EXPECT_EQ(touched[a], 1);
            EXPECT_LT((surface.velocity[a] - carried[a]).norm(), 1e-14);
            for (Index j = body.first_vertex; j < i; ++j) { // distances do not change
                const auto b = static_cast<std::size_t>(j);
                EXPECT_NEAR((surface.start[a] - surface.start[b])
                                .dot(surface.velocity[a] - surface.velocity[b]),
                            0.0, 1e-13);
            }
        }
    }
}

/// Impulses alone, without the solve before them.
TEST(CarriedMotion, ImpulsesStopBoxesThatMeetAndKeepMomentum) {
    const World world = build_quietly(boxes());
    ContactSolver solver(world, {});
    std::vector<Vec3> velocities = world.velocities;
    const std::vector<char> held(world.vertex_count(), 0);
    const double dt = 0.01;

    std::vector<Contact> contacts;
    solver.find_contacts(world, held, dt, contacts);
    const ContactReport report = solver.resolve(world, velocities, held, dt, contacts);

    Vec3 change = Vec3::Zero();
    World after = world;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        change += world.masses[i] * (velocities[i] - world.velocities[i]);
        after.positions[i] += dt * velocities[i];
    }
    EXPECT_GT(report.contacts_self, 0);
    EXPECT_EQ(report.unresolved, 0);
    const FourPoints upper = particles_of(world.rigids[1], velocities);
    EXPECT_GT(motion_of(upper, upper).velocity.y(), -0.6); // it was held up
    EXPECT_LT(change.norm(), 1e-12);
    EXPECT_TRUE(find_crossings(after, 1).empty());
}

} // namespace weft
