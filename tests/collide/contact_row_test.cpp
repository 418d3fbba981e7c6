#include "collide/proximity.h"
#include "support/contact_world.h"

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

TEST(Proximity, VertexOverAFaceIsNotHeldByTheFaceBeside) {
    // A vertex over one triangle of a flat floor, nearer to the diagonal than its thickness.
    World world;
    FabricParams fabric;
    fabric.thickness = 2e-3;
    test::add_sheet(world, 1, 0.1, 0.0, fabric);
    test::add_floor(world, 1.0, 0.0);
    ContactSurface surface = make_surface(world);
    place_surface(surface, world, std::vector<Vec3>(4, Vec3::Zero()), std::vector<char>(4, 0),
                  k_dt);
    surface.start[0] = Vec3(0.101, 2e-3, 0.1); // the diagonal is x = z
    const auto is_nearest = [&](Index triangle) {
        const Triangle& t = surface.triangles[static_cast<std::size_t>(triangle)];
        const Candidate candidate{.vertices = {0, t[0], t[1], t[2]},
                                  .triangles = {triangle, triangle},
                                  .rule = surface.rule_of(0, t[0]),
                                  .kind = PairKind::VertexFace};
        return is_nearest_here(
            surface, candidate,
            separation(PairKind::VertexFace, start_points(surface, candidate.vertices)));
    };

    EXPECT_NE(is_nearest(2), is_nearest(3)); // one of the floor's two triangles, not both
}

} // namespace weft
