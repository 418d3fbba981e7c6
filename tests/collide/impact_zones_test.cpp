#include "collide/impact_zones.h"
#include "support/contact_world.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// A sheet with velocities that differ from vertex to vertex, and a turning obstacle.
struct WildSheet {
    World world;
    ContactSurface surface;
    std::vector<char> touched;

    explicit WildSheet(std::vector<char> held = {}) {
        test::add_sheet(world, 3, 0.3, 0.0, {});
        test::add_sphere(world, 0.1, {0.0, 0.5, 0.0}, 0).params.motion = {
            {.t = 0.0}, {.t = 1.0, .translate = {1.0, 0.0, 0.0}, .rotate_deg = {0.0, 90.0, 0.0}}};
        std::vector<Vec3> velocities;
        for (std::size_t i = 0; i < world.vertex_count(); ++i) {
            const double s = static_cast<double>(i);
            velocities.emplace_back(std::sin(s), std::cos(2.0 * s), std::sin(3.0 * s));
        }
        held.resize(world.vertex_count(), 0);
        surface = make_surface(world);
        place_surface(surface, world, velocities, held, k_dt);
        touched.assign(surface.start.size(), 0);
    }

    Vec3 velocity(Index i) const { return surface.velocity[static_cast<std::size_t>(i)]; }
    Vec3 start(Index i) const { return surface.start[static_cast<std::size_t>(i)]; }

    int cut(const std::array<Index, 4>& pair, double strength, double toi) {
        const std::vector<Candidate> candidates{{.vertices = pair}};
        const std::vector<Impact> impacts{{0, toi}};
        ImpactZones zones;
        zones.reset(world.vertex_count());
        zones.join(surface, pair);
        return zones.scale_motion(surface, candidates, impacts, strength, k_dt, touched);
    }

    static constexpr double k_dt = 0.01;
};

} // namespace

TEST(ImpactZones, JoinByCommonVerticesButNotThroughInfiniteMasses) {
    const WildSheet scene({0, 0, 0, 0, 1});
    ImpactZones zones;
    zones.reset(scene.world.vertex_count());

    zones.join(scene.surface, {0, 1, 2, 4});
    zones.join(scene.surface, {4, 5, 6, 7});
    EXPECT_EQ(zones.of(0), zones.of(2));
    EXPECT_NE(zones.of(0), zones.of(5));

    zones.join(scene.surface, {7, 8, 9, 2});
    EXPECT_EQ(zones.of(9), 0);
    EXPECT_EQ(zones.of(5), 0);
}

TEST(CutBack, OfAFreeIslandMakesItRigidAndKeepsItsMomenta) {
    WildSheet scene;
    const std::array<Index, 4> pair{0, 1, 6, 11};
    const auto momenta = [&] {
        std::pair<Vec3, Vec3> sum(Vec3::Zero(), Vec3::Zero());
        for (const Index i : pair) {
            const double mass = scene.world.masses[static_cast<std::size_t>(i)];
            sum.first += mass * scene.velocity(i);
            sum.second += mass * scene.start(i).cross(scene.velocity(i));
        }
        return sum;
    };
    const auto before = momenta();

    EXPECT_EQ(scene.cut(pair, 0.0, 0.5), 1);

    const auto after = momenta();
    EXPECT_LT((after.first - before.first).norm(), 1e-15);
    EXPECT_LT((after.second - before.second).norm(), 1e-15);
    for (const Index i : pair) {
        for (const Index j : pair) { // rigid: no two vertices part or approach
            EXPECT_NEAR(
                (scene.velocity(i) - scene.velocity(j)).dot(scene.start(i) - scene.start(j)), 0.0,
                1e-14);
        }
    }
}

TEST(CutBack, OfAnIslandOnAnObstacleCarriesItAlong) {
    WildSheet scene;
    const Index on_sphere = scene.surface.deformable_vertices;

    scene.cut({5, on_sphere, on_sphere + 1, on_sphere + 2}, 0.0, 0.5);

    const ContactObject& sphere = scene.surface.objects[1];
    const Mat3 turn = sphere.end.rotation * sphere.start.rotation.transpose();
    const Vec3 end = turn * (scene.start(5) - sphere.start.translation) + sphere.end.translation;
    EXPECT_LT((scene.start(5) + WildSheet::k_dt * scene.velocity(5) - end).norm(), 1e-15);
}

TEST(CutBack, KeepsAShareOfTheMotionUpToTheImpact) {
    WildSheet scene;
    scene.surface.objects[1].end = scene.surface.objects[1].start; // the sphere rests
    const Vec3 before = scene.velocity(5);
    const Vec3 elsewhere = scene.velocity(3);
    const Index on_sphere = scene.surface.deformable_vertices;

    scene.cut({5, on_sphere, on_sphere + 1, on_sphere + 2}, 1.0, 0.5);

    EXPECT_LT((scene.velocity(5) - 0.4 * before).norm(), 1e-14); // 0.8 * 0.5
    EXPECT_EQ(scene.velocity(3), elsewhere);
    EXPECT_EQ(scene.touched[5], 1);
    EXPECT_EQ(scene.touched[3], 0);
}

TEST(ImpactZones, KeepTheirPlaceOnADeformingObstacleThatTurns) {
    // The obstacle deforms in name only: it turns about x as a whole.
    WildSheet scene;
    const Vec3 turning(3.0, 0.0, 0.0);
    const Index first = scene.surface.objects[1].first_vertex;
    const Index corner = first + 3;
    scene.surface.objects[1].deforms = true;
    for (Index v = first; v < static_cast<Index>(scene.surface.start.size()); ++v) {
        scene.surface.velocity[static_cast<std::size_t>(v)] = turning.cross(scene.start(v));
    }

    // A vertex of the sheet against a face: three vertices of the obstacle.
    scene.cut({2, corner, corner + 1, corner + 2}, 0.0, 0.5);

    EXPECT_LT((scene.velocity(2) - turning.cross(scene.start(2))).norm(), 1e-12);
}

} // namespace weft
