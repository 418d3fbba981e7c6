#include "base/atomic_file.h"
#include "base/error.h"
#include "frames/cache.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

/// A scene of one cloth and one turning obstacle, 10 frames a second.
Scene turning_scene() {
    Scene scene;
    scene.scene.fps = 10.0;
    scene.cloths.push_back({.name = "flag"});
    scene.cloths[0].fabric.name = "silk";
    ObstacleParams post{.name = "post"};
    post.placement.translate = Vec3(0.0, 2.0, 0.0);
    post.motion = {{.t = 0.0}, {.t = 1.0, .rotate_deg = Vec3(0.0, 90.0, 0.0)}};
    scene.obstacles.push_back(post);
    return scene;
}

RigidShape triangle_post(const Scene& scene) {
    RigidShape rigid{.shape = {.name = "post", .kind = ObjectKind::Obstacle},
                     .origin = scene.obstacles[0].placement.translate,
                     .motion = scene.obstacles[0].motion};
    rigid.shape.positions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    rigid.shape.triangles = {{0, 1, 2}};
    return rigid;
}

Frame flag_frame(int number) {
    FrameObject cloth{.name = "flag", .fabric = "silk"};
    cloth.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0.1F * static_cast<float>(number), 0}};
    cloth.material_positions = {{0, 0}, {1, 0}, {0, 1}};
    cloth.triangles = {{0, 1, 2}};
    return {.number = number, .time = (number - 1) / 10.0, .objects = {cloth}};
}

class Cache : public testing::Test {
protected:
    Cache() {
        std::filesystem::create_directories(paths.cache_dir());
        write_obstacles(paths, {triangle_post(scene)});
    }
    test::TempFolder folder;
    RunPaths paths{folder.path()};
    Scene scene = turning_scene();
};

TEST_F(Cache, GivesBackAFrameWithItsObstaclesPosed) {
    write_cache(paths, flag_frame(11));

    const Frame frame = CachedRun(folder.path(), scene).read(11);

    ASSERT_EQ(frame.objects.size(), 2U);
    EXPECT_EQ(frame.time, 1.0);
    EXPECT_EQ(frame.objects[0].positions, flag_frame(11).objects[0].positions);
    EXPECT_EQ(frame.objects[0].fabric, "silk");
    // A quarter turn about y takes x to -z; the placement lifts by 2 m.
    EXPECT_LT((frame.objects[1].positions[0] - Vec3f(0, 2, -1)).norm(), 1e-6F);
}

TEST_F(Cache, PosesTheSameBitsAsALiveRun) {
    write_cache(paths, flag_frame(4));

    const Frame frame = CachedRun(folder.path(), scene).read(4);

    EXPECT_EQ(frame.objects[1].positions, pose_shape(triangle_post(scene), 0.3).positions);
}

TEST_F(Cache, ListsOnlyFramesThatAreThereForEveryCloth) {
    for (const int number : {1, 2, 12, 10000}) {
        write_cache(paths, flag_frame(number));
    }
    scene.cloths.push_back({.name = "flag.0002"});
    Frame other = flag_frame(2);
    other.objects[0].name = "flag.0002";
    write_cache(paths, other);
    other.number = 10000;
    write_cache(paths, other);

    const CachedRun run(folder.path(), scene);

    EXPECT_EQ(run.frames(), (std::vector<int>{2, 10000}));
}

TEST_F(Cache, GivesBackAnObstacleThatDeforms) {
    RigidShape dancer{.shape = {.name = "dancer", .kind = ObjectKind::Obstacle},
                      .origin = Vec3::Zero(),
                      .motion = {}};
    dancer.shape.triangles = {{0, 1, 2}};
    dancer.shape.reach = {{-1, 0, 0}, {1, 2, 0}};
    scene.obstacles.push_back({.name = "dancer"});
    write_obstacles(paths, {triangle_post(scene), dancer});
    for (const int number : {3, 4}) {
        Frame frame = flag_frame(number);
        frame.objects.push_back(dancer.shape);
        const auto y = static_cast<float>(number);
        frame.objects.back().positions = {{0, y, 0}, {1, y, 0}, {0, y, 1}};
        write_cache(paths, frame);
    }
    write_cache(paths, flag_frame(5)); // the dancer is not there yet

    const CachedRun run(folder.path(), scene);

    EXPECT_EQ(run.frames(), (std::vector<int>{3, 4}));
    const FrameObject read = run.read(4).objects[2];
    EXPECT_EQ(read.kind, ObjectKind::Obstacle);
    EXPECT_EQ(read.positions[0], Vec3f(0, 4, 0));
    EXPECT_EQ(read.triangles, dancer.shape.triangles);
    EXPECT_EQ(read.reach, dancer.shape.reach);
}

TEST_F(Cache, NamesAMissingFileInOneLine) {
    try {
        CachedRun(folder.path(), scene).read(3);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::Disk);
        EXPECT_EQ(std::string(error.what()),
                  paths.shape("flag", 3).string() + ": cannot read: No such file or directory");
    }
}

} // namespace
} // namespace weft
