#include "state/obstacle.h"
#include "state/pin.h"
#include "support/objects.h"

#include <gtest/gtest.h>

#include <atomic>

namespace weft {

namespace {

/// A sphere that grows by half its size a second, its evaluations counted.
Obstacle& add_growing_sphere(World& world, std::atomic<int>& evaluations) {
    Obstacle& sphere = test::add_sphere(world, 0.1, {0.0, 0.5, 0.0}, 1);
    const std::vector<Vec3> rest = sphere.mesh.positions;
    sphere.deformation = std::make_shared<Deformation>(
        rest.size(), 7, [rest, &evaluations](double t, std::span<Vec3> positions) {
            ++evaluations;
            for (std::size_t i = 0; i < rest.size(); ++i) {
                positions[i] = (1.0 + 0.5 * t) * rest[i];
            }
        });
    return sphere;
}

std::vector<Vec3> positions_at(const Obstacle& obstacle, double t) {
    std::vector<Vec3> positions(obstacle.mesh.positions.size());
    obstacle_positions(obstacle, t, positions);
    return positions;
}

} // namespace

TEST(Obstacle, MovesItsDeformedShapeByItsKeyFrames) {
    World world;
    std::atomic<int> evaluations = 0;
    Obstacle& sphere = add_growing_sphere(world, evaluations);
    sphere.params.motion = {
        {.t = 0.0}, {.t = 2.0, .translate = {1.0, 0.0, 0.0}, .rotate_deg = {0.0, 180.0, 0.0}}};

    const std::vector<Vec3> positions = positions_at(sphere, 1.0);

    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3 grown = 1.5 * sphere.mesh.positions[i];
        const Vec3 turned(grown.z(), grown.y(), -grown.x()); // a quarter turn about y
        EXPECT_LT((positions[i] - (turned + Vec3(0.5, 0.5, 0.0))).norm(), 1e-12);
    }
}

TEST(Obstacle, CornersOfATriangleAreTheSameBitsAsThePositions) {
    World world;
    std::atomic<int> evaluations = 0;
    const Obstacle& sphere = add_growing_sphere(world, evaluations);

    const std::vector<Vec3> positions = positions_at(sphere, 0.3);

    for (std::size_t t = 0; t < sphere.mesh.triangles.size(); ++t) {
        const auto corners = obstacle_corners(sphere, static_cast<Index>(t), 0.3);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto v = static_cast<std::size_t>(sphere.mesh.triangles[t][k]);
            EXPECT_EQ(corners[k], positions[v]);
        }
    }
}

TEST(Deformation, EvaluatesOnceForEachTimeOfASubstep) {
    World world;
    std::atomic<int> evaluations = 0;
    const Obstacle& sphere = add_growing_sphere(world, evaluations);

    for (int i = 0; i < 3; ++i) {
        positions_at(sphere, 0.1);
        positions_at(sphere, 0.2);
    }

    EXPECT_EQ(evaluations, 2);
}

TEST(Deformation, DoesNotDependOnWhatWasAskedBefore) {
    World world;
    std::atomic<int> evaluations = 0;
    const Obstacle& sphere = add_growing_sphere(world, evaluations);
    const Deformation::Positions kept = sphere.deformation->at(0.1);
    const std::vector<Vec3> first = *kept;

    for (int i = 2; i < 20; ++i) {
        positions_at(sphere, 0.1 * i);
    }

    EXPECT_EQ(*kept, first); // what is still held is not overwritten
    EXPECT_EQ(*sphere.deformation->at(0.1), first);
}

TEST(Pin, FollowsATriangleOfADeformingObstacle) {
    World world;
    std::atomic<int> evaluations = 0;
    const Obstacle& sphere = add_growing_sphere(world, evaluations);
    const Vec3 centre(0.0, 0.5, 0.0);
    const Triangle& t = sphere.mesh.triangles[5];
    const auto rest = [&](std::size_t k) {
        return sphere.mesh.positions[static_cast<std::size_t>(t[k])];
    };
    const Vec3 middle = (rest(0) + rest(1) + rest(2)) / 3.0;
    const Vec3 normal = triangle_normal(rest(0), rest(1), rest(2));
    const Vec3 start = centre + middle + 0.01 * normal;
    const Pin pin{.vertex = 0, .start = start, .anchor = anchor_to(sphere, 0, start), .group = 0};

    const Vec3 end = pin_position(pin, {}, world.obstacles, 2.0);

    // The triangle is twice as far out; the height above it stays.
    EXPECT_LT((end - (centre + 2.0 * middle + 0.01 * normal)).norm(), 1e-12);
}

} // namespace weft
