#include "collide/crossings.h"
#include "geometry/crossing.h"
#include "support/contact_world.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// A sheet through the middle of a sphere, and a second one that stands across the first.
World crossed_world() {
    World world;
    test::add_sheet(world, 6, 0.5, 0.01, {});
    const Cloth& second = test::add_sheet(world, 5, 0.45, 0.0, {});
    for (Index i = 0; i < second.vertex_count; ++i) {
        Vec3& x = world.positions[static_cast<std::size_t>(second.first_vertex + i)];
        x = Vec3(x.x(), x.z(), 0.013 + 0.1 * x.x());
    }
    test::add_sphere(world, 0.1, Vec3::Zero(), 1);
    return world;
}

std::size_t count_by_brute_force(const World& world) {
    std::vector<Vec3> x = world.positions;
    std::vector<Triangle> triangles;
    for (const Cloth& cloth : world.cloths) {
        for (const Triangle& t : cloth.triangles) {
            triangles.push_back(
                {t[0] + cloth.first_vertex, t[1] + cloth.first_vertex, t[2] + cloth.first_vertex});
        }
    }
    const std::size_t deformable = triangles.size();
    const auto first = static_cast<Index>(x.size());
    x.insert(x.end(), world.obstacles[0].mesh.positions.begin(),
             world.obstacles[0].mesh.positions.end());
    for (const Triangle& t : world.obstacles[0].mesh.triangles) {
        triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < deformable; ++i) {
        for (std::size_t j = i + 1; j < triangles.size(); ++j) {
            count += triangles_cross(triangles[i], triangles[j], x);
        }
    }
    return count;
}

} // namespace

TEST(Crossings, AreAllFoundOnceAndSorted) {
    const World world = crossed_world();

    const std::vector<UnresolvedPair> pairs = find_crossings(world, 100000);

    EXPECT_GT(pairs.size(), 50U);
    EXPECT_EQ(pairs.size(), count_by_brute_force(world));
    EXPECT_EQ(object_name(world, pairs.front().objects[0]), "sheet0");
    EXPECT_EQ(object_name(world, pairs.back().objects[1]), "obstacle0");
    EXPECT_EQ(find_crossings(world, 7).size(), 7U);
}

TEST(Crossings, AtTheStartAreCountedAsUnresolved) {
    World world = crossed_world();
    ContactSolver solver(world, {});

    const ContactReport report = test::contact_step(world, solver, 1e-3);

    EXPECT_GT(report.unresolved, 50);
    EXPECT_EQ(static_cast<std::size_t>(report.unresolved), find_crossings(world, 100000).size());
}

TEST(Crossings, OfClothThatOnlyLiesNearAreNone) {
    World world;
    test::add_sheet(world, 6, 0.5, 0.1001, {});
    test::add_sphere(world, 0.1, Vec3::Zero(), 2);

    EXPECT_TRUE(find_crossings(world, 10).empty());
}

} // namespace weft
