#include "scene/scene_reader.h"
#include "state/build_world.h"
#include "step/advance.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

/// A soft cube of 64 particles on a floor, under a rigid one of twenty times its weight.
constexpr const char* k_scene = R"(
[scene]
air_density = 0.0
[[solid]]
name = "soft"
box = [0.06, 0.06, 0.06]
spacing = 0.02
translate = [0.0, 0.031, 0.0]
model = "linear"
[solid.spring]
K = 20.0
limit = [0.9, 1.1]
damping = 0.2
mass = 0.05
[[rigid]]
name = "load"
shape = "box"
size = [0.06, 0.06, 0.06]
translate = [0.0, 0.0925, 0.0]
mass = 1.0
[[obstacle]]
name = "floor"
shape = "box"
size = [2.0, 0.1, 2.0]
translate = [0.0, -0.05, 0.0]
)";

/// Of the sides and diagonals of the lattice.
double least_stretch(const World& world) {
    const Solid& solid = world.solids[0];
    double least = k_forever;
    for (const NetworkEdge& edge : solid.network) {
        const auto at = [&](std::size_t i) {
            return world
                .positions[static_cast<std::size_t>(solid.body.first_particle + edge.vertices[i])];
        };
        least = std::min(least, (at(1) - at(0)).norm() / edge.rest_length);
    }
    return least;
}

} // namespace

// Contact as soft as the solid let impulses carry the load, which know nothing of what is behind a
// surface: the layer beside the floor was pressed anew in each substep, far past the limit.
TEST(LoadedSolid, KeepsItsLimitHoweverSoftUnderAHeavyBody) {
    const Scene scene = read_scene_text(k_scene, "a.toml", ".");
    World world = build_world(scene, [](const std::string&) {});
    Stepper stepper({world, scene.scene, scene.contact});
    for (int i = 0; i < 25; ++i) {
        EXPECT_EQ(stepper.advance_frame(world, nullptr)->contact.unresolved, 0);
    }
    EXPECT_GE(least_stretch(world), 0.9 * 0.99);
    EXPECT_LT(least_stretch(world), 0.97) << "the load is felt";
}

} // namespace weft
