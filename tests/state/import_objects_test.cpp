#include "base/error.h"
#include "state/build_world.h"
#include "support/real_models.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

#include <cstring>

namespace weft {

namespace {

/// A triangle of the file's axes, its first corner at x, in OBJ.
std::string triangle(double x) {
    return fmt::format("v {} 0 0\nv 0 100 0\nv 0 0 100\nf 1 2 3\n", x);
}

/// The triangle in n files b.1.obj ...: its first corner moves by 100 units a file.
ObstacleParams sequence_in(const test::TempFolder& folder, int files) {
    for (int k = 0; k < files; ++k) {
        test::write_file(folder / fmt::format("b.{}.obj", k + 1), triangle(100.0 * (k + 1)));
    }
    ObstacleParams params{.name = "b"};
    params.mesh.file = "b.#.obj";
    params.animation.is_sequence = true;
    return params;
}

Obstacle build(const ObstacleParams& params, const std::filesystem::path& folder) {
    World world;
    return add_obstacle(world, params, import_obstacle(params, folder, 10.0, ignore_warning));
}

/// World place of the triangle's first corner.
Vec3 corner_at(const Obstacle& obstacle, double t) {
    return obstacle_corners(obstacle, 0, t)[0];
}

std::string pc2_of_corner(int samples) {
    std::string bytes("POINTCACHE2\0", 12);
    const auto add = [&](auto value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    add(std::int32_t{1});
    add(std::int32_t{3});
    add(0.0F);
    add(1.0F);
    add(std::int32_t{samples});
    for (int k = 0; k < samples; ++k) {
        for (const float x : {100.0F * static_cast<float>(k + 1), 0.0F, 0.0F, 0.0F, 100.0F, 0.0F,
                              0.0F, 0.0F, 100.0F}) {
            add(x);
        }
    }
    return bytes;
}

std::string refusal(const ObstacleParams& params, const std::filesystem::path& folder) {
    try {
        build(params, folder);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::BadInput);
        return error.what();
    }
    return "";
}

} // namespace

TEST(BuildObstacle, PlaysASequenceInItsUnitAxesAndPlacement) {
    const test::TempFolder folder;
    ObstacleParams params = sequence_in(folder, 3);
    params.mesh.units_given = true;
    params.mesh.metres_per_unit = 0.01;
    params.placement = {.translate = {0.0, 5.0, 0.0}, .rotate_deg = {0.0, 90.0, 0.0}, .scale = 2.0};

    const Obstacle obstacle = build(params, folder.path());

    ASSERT_TRUE(deforms(obstacle));
    // x in m, doubled, a quarter turn about y takes it to -z; a file every 0.1 s.
    for (const auto& [t, x] : std::vector<std::pair<double, double>>{
             {0.0, 1.0}, {0.05, 1.5}, {0.1, 2.0}, {0.2, 3.0}, {9.0, 3.0}}) {
        EXPECT_LT((corner_at(obstacle, t) - Vec3(0.0, 5.0, -2.0 * x)).norm(), 1e-6) << t;
    }
    EXPECT_EQ(obstacle.mesh.positions, *obstacle.deformation->at(0.0));
}

TEST(BuildObstacle, SequenceStartsRunsAndLoopsAsAsked) {
    const test::TempFolder folder;
    ObstacleParams params = sequence_in(folder, 3);
    params.animation.fps = 1.0;
    params.animation.start = 1.0;
    params.animation.speed = 4.0;
    params.animation.end = AnimationEnd::Loop;
    params.motion = {{.t = 0.0, .translate = {0.0, 7.0, 0.0}}};

    const Obstacle obstacle = build(params, folder.path());

    EXPECT_LT((corner_at(obstacle, 0.9) - Vec3(100.0, 7.0, 0.0)).norm(), 1e-12);
    EXPECT_LT((corner_at(obstacle, 1.25) - Vec3(200.0, 7.0, 0.0)).norm(), 1e-12);
    EXPECT_LT((corner_at(obstacle, 1.625) - Vec3(150.0, 7.0, 0.0)).norm(), 1e-12);
}

TEST(BuildObstacle, RefusesASequenceByTheFileThatDiffers) {
    const test::TempFolder folder;
    const ObstacleParams params = sequence_in(folder, 3);
    const std::uint64_t before = build(params, folder.path()).deformation->fingerprint();

    test::write_file(folder / "b.3.obj", triangle(300.001));
    EXPECT_NE(build(params, folder.path()).deformation->fingerprint(), before);

    test::write_file(folder / "b.3.obj", triangle(1.0) + "v 0 1 1\nf 1 2 4\n");
    EXPECT_EQ(refusal(params, folder.path()),
              "b.3.obj: 6 vertices and 2 triangles, b.1.obj has 3 and 1: must be the same mesh in "
              "each file");

    test::write_file(folder / "b.3.obj", triangle(1.0).substr(0, 20));
    EXPECT_EQ(refusal(params, folder.path()).substr(0, 8), "b.3.obj:");
}

TEST(BuildObstacle, PlaysAPointCache) {
    const test::TempFolder folder;
    test::write_file(folder / "b.obj", triangle(100.0));
    test::write_file(folder / "b.pc2", pc2_of_corner(3));
    ObstacleParams params{.name = "b"};
    params.mesh.file = "b.obj";
    params.animation.cache = "b.pc2";

    const Obstacle obstacle = build(params, folder.path());

    EXPECT_LT((corner_at(obstacle, 0.15) - Vec3(250.0, 0.0, 0.0)).norm(), 1e-9);
    params.animation.fps = 1.0;
    EXPECT_LT((corner_at(build(params, folder.path()), 0.5) - Vec3(150.0, 0.0, 0.0)).norm(), 1e-9);
    test::write_file(folder / "b.pc2", pc2_of_corner(3).substr(0, 100));
    EXPECT_EQ(refusal(params, folder.path()),
              "b.pc2: truncated: 3 samples of 3 points need 140 bytes, it has 100");
}

TEST(BuildObstacle, PlaysTheAnimationOfItsFileUnlessToldNot) {
    WEFT_NEEDS_REAL_MODELS();
    ObstacleParams params{.name = "bull"};
    params.mesh.file = "X/Testwuson.X";
    params.mesh.repair = true;
    params.placement.translate = Vec3(0.0, 3.0, 0.0);

    const Obstacle bull = build(params, test::k_real_models);
    ASSERT_TRUE(deforms(bull)); // the first: it runs
    std::vector<Vec3> early(bull.mesh.positions.size());
    std::vector<Vec3> late(early.size());
    obstacle_positions(bull, 0.2, early);
    obstacle_positions(bull, 0.5, late);
    double farthest = 0.0;
    for (std::size_t i = 0; i < early.size(); ++i) {
        farthest = std::max(farthest, (late[i] - early[i]).norm());
        EXPECT_GT(early[i].y(), 2.9);
    }
    EXPECT_GT(farthest, 0.3); // the hooves

    params.animation.name = "none";
    EXPECT_FALSE(deforms(build(params, test::k_real_models)));
    params.animation.name = "Rest";
    EXPECT_EQ(refusal(params, test::k_real_models).substr(0, 25), "X/Testwuson.X: animation ");
}

} // namespace weft
