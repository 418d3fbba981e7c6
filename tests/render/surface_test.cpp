#include "render/ambient_occlusion.h"
#include "render/surface.h"
#include "support/picture_frames.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

TEST(Surface, NormalsOfASmoothBallPointOutwards) {
    Surface surface;

    append_smooth(surface, test::ball(1.0, 48), {});

    int poor = 0;
    for (std::size_t v = 0; v < surface.positions.size(); ++v) {
        poor += surface.normals[v].dot(surface.positions[v]) < 0.99F ? 1 : 0;
    }
    EXPECT_LE(poor, 2 * 49); // at the poles a vertex of the grid has triangles of no area
    EXPECT_EQ(surface.triangles.size(), 2U * 48U * 48U);
}

TEST(Surface, ABoxKeepsFlatSides) {
    Surface surface;

    append_creased(surface, test::box(Vec3::Zero(), Vec3::Ones()));

    EXPECT_EQ(surface.positions.size(), 24U); // three sides meet at each of eight corners
    for (const Vec3f& normal : surface.normals) {
        EXPECT_FLOAT_EQ(normal.cwiseAbs().maxCoeff(), 1.0F);
    }
}

TEST(Surface, ASmoothObstacleIsNotSplit) {
    Surface surface;
    const FrameObject cloth = test::square_cloth(1.0, 4, [](double, double) { return 1.0; });

    append_creased(surface, cloth);

    EXPECT_EQ(surface.positions.size(), cloth.positions.size());
}

TEST(Surface, SeveralObjectsKeepTheirOwnVertices) {
    Surface surface;
    const FrameObject square = test::square_cloth(1.0, 1, [](double, double) { return 1.0; });

    append_smooth(surface, square, square.values[0]);
    append_smooth(surface, square, square.values[0]);

    ASSERT_EQ(surface.triangles.size(), 4U);
    EXPECT_EQ(surface.triangles[2][0], surface.triangles[0][0] + 4);
    EXPECT_EQ(surface.values.size(), surface.positions.size());
}

/// Light of the first vertex of a small level patch at the origin.
Ambient light_of_patch(const Surface* above) {
    FrameObject patch = test::square_cloth(0.02, 1, [](double, double) { return 1.0; });
    for (Vec3f& x : patch.positions) {
        x = Vec3f(x.x(), 0.0F, -x.y());
    }
    Surface surface;
    append_smooth(surface, patch, {});
    Surface* receiver = &surface;
    std::vector<const Surface*> casters{&surface};
    if (above != nullptr) {
        casters.push_back(above);
    }
    add_ambient_occlusion({&receiver, 1}, casters, Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
    return surface.ambient[0];
}

TEST(Surroundings, AFreeLevelPatchGetsAllOfTheSkyAndNothingOfTheFloor) {
    const Ambient light = light_of_patch(nullptr);

    EXPECT_NEAR(light.front_sky, 1.0F, 0.02F);
    EXPECT_NEAR(light.front_floor, 0.0F, 0.02F);
    EXPECT_NEAR(light.back_floor, 1.0F, 0.02F);
}

TEST(Surroundings, ALidTakesTheCosineWeightedShareThatItCovers) {
    FrameObject lid = test::square_cloth(2.0, 1, [](double, double) { return 1.0; });
    for (Vec3f& x : lid.positions) {
        x = Vec3f(x.x() + 1.0F, 0.3F, -x.y()); // over the half x > 0
    }
    Surface surface;
    append_smooth(surface, lid, {});

    const Ambient light = light_of_patch(&surface);

    // a half plane overhead hides half of the cosine-weighted sky, less what passes under its rims
    EXPECT_NEAR(light.front_sky, 0.55F, 0.08F);
    EXPECT_NEAR(light.back_floor, 1.0F, 0.02F);
}

} // namespace
} // namespace weft
