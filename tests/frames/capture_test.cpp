#include "frames/capture.h"
#include "support/grid_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {
namespace {

/// Applies a map to every vertex.
template <typename Map> void deform(World& world, const Map& map) {
    for (Vec3& x : world.positions) {
        x = map(x);
    }
}

const std::vector<float>& values(const Frame& frame, std::string_view quantity) {
    return frame.objects[0].values[static_cast<std::size_t>(find_quantity(quantity))];
}

void expect_all(const Frame& frame, std::string_view quantity, double expected, double tolerance) {
    ASSERT_EQ(values(frame, quantity).size(), frame.objects[0].positions.size()) << quantity;
    for (const float value : values(frame, quantity)) {
        EXPECT_NEAR(value, expected, tolerance) << quantity;
    }
}

Frame capture(const World& world) {
    return FrameCapture(world, 25.0).capture(world);
}

TEST(Capture, OfTheRestShapeIsNeutral) {
    const Frame frame = capture(test::grid_world(1.0, 4));

    expect_all(frame, "stretch", 1.0, 1e-6);
    for (const char* quantity :
         {"strain_weft", "strain_warp", "shear", "stress", "curvature", "speed"}) {
        expect_all(frame, quantity, 0.0, 1e-4);
    }
}

TEST(Capture, ShowsAUniformStretchAtEveryVertex) {
    World world = test::grid_world(1.0, 4);
    deform(world, [](const Vec3& x) { return Vec3(1.1 * x.x(), x.y(), 0.95 * x.z()); });

    const Frame frame = capture(world);

    // x is along one thread direction, z along the other; which is weft is the rest shape's matter.
    expect_all(frame, "stretch", 1.1, 1e-6);
    const double sum = static_cast<double>(values(frame, "strain_weft")[0]) +
                       static_cast<double>(values(frame, "strain_warp")[0]);
    EXPECT_NEAR(sum, 10.0 - 5.0, 1e-4);
}

TEST(Capture, ShowsTheTensionOfATautSheet) {
    World world = test::grid_world(1.0, 4);
    deform(world, [](const Vec3& x) { return Vec3(1.1 * x.x(), x.y(), 1.1 * x.z()); });
    const FabricParams& fabric = world.cloths[0].params.fabric;

    // Both ways alike: E e / (1 - nu), isotropic plane stress.
    const double expected = fabric.stretch_stiffness[0] * 0.1 / (1.0 - fabric.poisson);
    expect_all(capture(world), "stress", expected, 1e-3 * expected);
}

TEST(Capture, ShowsTheShearAngle) {
    World world = test::grid_world(1.0, 4);
    const double angle = 10.0 * std::numbers::pi / 180.0; // threads along z lean over by 10 degrees
    deform(world, [&](const Vec3& x) {
        return Vec3(x.x() + std::sin(angle) * x.z(), x.y(), std::cos(angle) * x.z());
    });

    const Frame frame = capture(world);

    for (const float value : values(frame, "shear")) {
        EXPECT_NEAR(std::abs(value), 10.0, 1e-4);
    }
}

TEST(Capture, ShowsSpeed) {
    World world = test::grid_world(1.0, 2);
    world.velocities.assign(world.vertex_count(), Vec3(0.0, -3.0, 4.0));

    expect_all(capture(world), "speed", 5.0, 1e-6);
}

TEST(Capture, ShowsTheLevelOfRefinement) {
    World world = test::grid_world(1.0, 2);
    expect_all(capture(world), "level", 0.0, 0.0);

    Cloth& cloth = world.cloths[0];
    cloth.refinement.base_vertices = cloth.vertex_count;
    cloth.refinement.triangles.assign(cloth.triangles.size(), {.generation = 3});
    expect_all(capture(world), "level", 2.0, 0.0);
}

/// A vertex that is a corner of one triangle only.
Index lone_corner(const Cloth& cloth) {
    std::vector<int> triangles(static_cast<std::size_t>(cloth.vertex_count), 0);
    for (const Triangle& triangle : cloth.triangles) {
        for (const Index v : triangle) {
            ++triangles[static_cast<std::size_t>(v)];
        }
    }
    return static_cast<Index>(std::find(triangles.begin(), triangles.end(), 1) - triangles.begin());
}

TEST(Capture, AveragesTheTrianglesAroundAVertex) {
    World world = test::grid_world(1.0, 1); // two triangles of equal area share two vertices
    world.positions[static_cast<std::size_t>(lone_corner(world.cloths[0]))].y() += 0.2;

    const Frame frame = capture(world);

    const auto& stretch = values(frame, "stretch");
    const float greatest = *std::max_element(stretch.begin(), stretch.end());
    EXPECT_GT(greatest, 1.01F);
    EXPECT_NEAR(*std::min_element(stretch.begin(), stretch.end()), 1.0F, 1e-6F);
    const auto is_half_way = [&](float s) {
        return std::abs(s - 0.5F * (1.0F + greatest)) < 1e-6F;
    };
    EXPECT_EQ(std::count_if(stretch.begin(), stretch.end(), is_half_way), 2);
}

TEST(Capture, TakesADeformingObstacleAsItStands) {
    World world = test::grid_world(1.0, 4);
    Obstacle post{.name = "post"};
    post.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    post.mesh.triangles = {{0, 1, 2}};
    post.origin = Vec3(0.0, 3.0, 0.0);
    post.deformation = std::make_shared<Deformation>(
        3, 0, [rest = post.mesh.positions](double t, std::span<Vec3> positions) {
            for (std::size_t i = 0; i < 3; ++i) {
                positions[i] = (1.0 + t) * rest[i];
            }
        });
    world.obstacles.push_back(post);
    world.time = 0.5;

    const Frame frame = FrameCapture(world, 2.0, 5).capture(world); // to t = 2 s

    const FrameObject& taken = frame.objects[1];
    EXPECT_EQ(taken.positions[1], Vec3f(1.5F, 3.0F, 0.0F));
    EXPECT_TRUE(std::find(taken.reach.begin(), taken.reach.end(), Vec3f(3.0F, 3.0F, 0.0F)) !=
                taken.reach.end());
}

} // namespace
} // namespace weft
