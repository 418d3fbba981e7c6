#include "scene/scene_reader.h"
#include "state/build_world.h"
#include "state/world.h"
#include "step/advance.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace weft {
namespace {

/// A cloth of 12 x 12 particles that hangs by an edge and carries ten times its weight.
Scene loaded(const std::string& spring) {
    return read_scene_text("[scene]\ngravity = [0.0, -107.9, 0.0]\nair_density = 0.0\n"
                           "[contact]\nenabled = false\n"
                           "[[cloth]]\nname = \"net\"\nmodel = \"linear\"\n"
                           "grid = { size = [0.22, 0.22], cells = [11, 11] }\n"
                           "rotate_deg = [90.0, 0.0, 0.0]\n[cloth.spring]\n" +
                               spring +
                               "[[cloth.pin]]\nbox = { min = [-1.0, 0.1, -1.0], max = [1.0, 1.0, "
                               "1.0] }\n",
                           "a.toml", ".");
}

struct Stretches {
    double least = k_forever, greatest = 0.0;
};

/// Of the sides and diagonals after some frames.
Stretches stretches_after(const Scene& scene, int frames) {
    World world = build_world(scene, [](const std::string&) {});
    Stepper stepper({world, scene.scene, scene.contact});
    for (int i = 0; i < frames; ++i) {
        stepper.advance_frame(world, nullptr);
    }
    Stretches result;
    for (const NetworkEdge& edge : world.cloths[0].network) {
        if (edge.kind != EdgeKind::Bending) {
            const Vec3 across = world.positions[static_cast<std::size_t>(edge.vertices[1])] -
                                world.positions[static_cast<std::size_t>(edge.vertices[0])];
            result.least = std::min(result.least, across.norm() / edge.rest_length);
            result.greatest = std::max(result.greatest, across.norm() / edge.rest_length);
        }
    }
    return result;
}

} // namespace

TEST(EdgeCloth, KeepsItsLimitUnderTenTimesItsWeightHoweverSoft) {
    for (const std::string K : {"10.0", "100.0"}) {
        const Stretches rest =
            stretches_after(loaded("K = " + K + "\nlimit = [0.9, 1.1]\ndamping = 0.05\n"), 30);

        EXPECT_LE(rest.greatest, 1.1 * 1.01) << K;
        EXPECT_GE(rest.least, 0.9 * 0.99) << K;
    }
}

TEST(EdgeCloth, WithoutALimitStretchesFarPastIt) {
    EXPECT_GT(stretches_after(loaded("K = 100.0\ndamping = 0.05\n"), 30).greatest, 1.3);
}

} // namespace weft
