#include "base/error.h"
#include "state/build_world.h"
#include "state/rigid_motion.h"
#include "support/temp_folder.h"
#include "support/text_file.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

namespace weft {

using namespace test;

namespace {

const std::string k_corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string k_sides = "f 1 3 2\nf 1 2 4\nf 1 4 3\n";

RigidParams from_mesh(const std::string& file) {
    RigidParams rigid;
    rigid.name = "stone";
    rigid.mesh.file = file;
    rigid.mass = 6.0;
    return rigid;
}

std::string message_of(const TempFolder& folder, const RigidParams& params) {
    World world;
    try {
        add_rigid(world, params, import_rigid(params, folder.path(), ignore_warning));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(BuildRigid, AClosedMeshHasItsCentreAndFollowsItsParticles) {
    const TempFolder folder;
    for (const std::string last : {"f 2 3 4\n", "f 2 4 3\n"}) { // the other way round: turned
        write_file(folder / "stone.obj", k_corners + k_sides + last);
        World world;

        const RigidParams params = from_mesh("stone.obj");
        add_rigid(world, params, import_rigid(params, folder.path(), ignore_warning));

        ASSERT_EQ(check(world), "");
        const FourPoints x = particles_of(world.rigids[0], world.positions);
        const Vec3 centre = 0.25 * (x[0] + x[1] + x[2] + x[3]);
        EXPECT_LT((centre - Vec3(0.25, 0.25, 0.25)).norm(), 1e-7); // centroid of the tetrahedron
        EXPECT_EQ(world.masses[4], 1.5);
        double farthest = 0.0;
        for (std::size_t v = 0; v < 4; ++v) {
            farthest = std::max(farthest, world.positions[v].lpNorm<1>());
        }
        EXPECT_NEAR(farthest, 1.0, 1e-7);
    }
}

TEST(BuildRigid, RefusesAnOpenMeshAtItsPlace) {
    const TempFolder folder;
    write_file(folder / "bowl.obj", k_corners + k_sides);

    const std::string message = message_of(folder, from_mesh("bowl.obj"));

    EXPECT_EQ(message.find("rigid 'stone': bowl.obj: is open beside triangle 0, at ("), 0u)
        << message;
}

TEST(BuildRigid, RefusesAMeshThatCrossesItself) {
    const TempFolder folder;
    std::string text = k_corners + k_sides + "f 2 3 4\n";
    text += "v 0.1 0.1 0.1\nv 1.1 0.1 0.1\nv 0.1 1.1 0.1\nv 0.1 0.1 1.1\n";
    text += "f 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";
    write_file(folder / "two.obj", text);

    const std::string message = message_of(folder, from_mesh("two.obj"));

    EXPECT_EQ(message.find("rigid 'stone': two.obj: crosses itself: triangles "), 0u) << message;
}

TEST(BuildRigid, NeedsImplicitEuler) {
    Scene scene;
    scene.scene.integrator = Integrator::Bdf2;
    scene.rigids.push_back(from_mesh(""));
    scene.rigids[0].shape = Shape::Sphere;

    EXPECT_THROW(build_quietly(scene), Error);
}

} // namespace weft
