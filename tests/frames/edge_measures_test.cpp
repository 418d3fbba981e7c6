#include "frames/capture.h"
#include "frames/measures.h"
#include "frames/statistics.h"
#include "scene/scene_reader.h"
#include "state/world.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

/// A grid of the model, strained along x and y of the sheet.
World strained_grid(const std::string& model, double along_x, double along_z) {
    World world = build_world(
        read_scene_text("[[cloth]]\nname = \"net\"\ngrid = { size = [0.4, 0.4], cells = [4, 4] }\n"
                        "model = \"" +
                            model + "\"\n[cloth.spring]\nK = 500.0\nbend = 10.0\n",
                        "a.toml", "."),
        [](const std::string&) {});
    for (Vec3& x : world.positions) {
        x = Vec3(along_x * x.x(), x.y(), along_z * x.z());
    }
    return world;
}

} // namespace

TEST(EdgeMeasures, StretchIsLengthOverRestLengthOfSidesAndDiagonals) {
    const World world = strained_grid("linear", 1.2, 0.9);

    const StrainStatistics strain = measure_strain(world);

    EXPECT_NEAR(strain.stretch_max, 1.2, 1e-12);
    EXPECT_NEAR(strain.stretch_min, 0.9, 1e-12);
    const double diagonal = std::sqrt((1.2 * 1.2 + 0.9 * 0.9) / 2.0);
    EXPECT_NEAR(strain.stretch_mean, (20.0 * 1.2 + 20.0 * 0.9 + 32.0 * diagonal) / 72.0, 1e-12);
}

TEST(EdgeMeasures, EnergyIsThatOfSpringsSummedByHand) {
    const World world = strained_grid("linear", 1.2, 1.0);

    const MotionStatistics motion = StatisticsCollector(world, {}).measure(world, {}, 0).motion;

    const double diagonal = 0.1 * (std::sqrt(1.2 * 1.2 + 1.0) - std::sqrt(2.0));
    EXPECT_NEAR(motion.membrane, 0.5 * 500.0 * (20.0 * 0.02 * 0.02 + 32.0 * diagonal * diagonal),
                1e-12);
    EXPECT_NEAR(motion.bending, 0.5 * 10.0 * 15.0 * 0.04 * 0.04, 1e-12);
}

TEST(EdgeMeasures, VerticesHaveTheMeanOfTheirEdges) {
    const World world = strained_grid("cubic", 1.1, 1.1);

    const Frame frame = FrameCapture(world, 25.0, 1).capture(world);

    const auto quantity = static_cast<std::size_t>(find_quantity("stretch"));
    for (const float stretch : frame.objects[0].values[quantity]) {
        EXPECT_NEAR(stretch, 1.1, 1e-6);
    }
}

} // namespace weft
