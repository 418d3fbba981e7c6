#include "base/error.h"
#include "geometry/mesh_repair.h"
#include "state/build_world.h"
#include "support/closed_meshes.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

#include <numeric>

namespace weft {

using namespace test;

namespace {

std::string obj_of(const TriangleMesh& mesh) {
    std::string text;
    for (const Vec3& x : mesh.positions) {
        text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", x.x(), x.y(), x.z());
    }
    for (const Triangle& t : mesh.triangles) {
        text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    }
    return text;
}

Scene scene_of(const SolidParams& params) {
    Scene scene;
    scene.solids.push_back(params);
    return scene;
}

World build(const Scene& scene) {
    return build_world(scene, [](const std::string&) {});
}

/// A world of one solid made of a mesh.
World build(SolidParams params, const TriangleMesh& mesh) {
    const TempFolder folder;
    write_file(folder / "a.obj", obj_of(mesh));
    params.mesh.file = "a.obj";
    Scene scene = scene_of(params);
    scene.base_dir = folder.path();
    return build(scene);
}

std::string refusal(const SolidParams& params, const TriangleMesh& mesh) {
    try {
        build(params, mesh);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::BadInput);
        return error.what();
    }
    return "";
}

SolidParams k_cube() {
    SolidParams params{.name = "cube", .box = Vec3::Constant(0.16)};
    params.spring.mass = 0.71;
    params.placement.translate = {0.0, 1.0, 0.0};
    params.placement.rotate_deg = {10.0, 20.0, 30.0};
    return params;
}

double mass_of(const World& world) {
    return std::accumulate(world.masses.begin(), world.masses.end(), 0.0);
}

} // namespace

TEST(BuildSolid, CubeOfThePaperHas729ParticlesAndItsMass) {
    const World world = build(scene_of(k_cube()));

    EXPECT_EQ(check(world), "");
    ASSERT_EQ(world.solids.size(), 1u);
    const Solid& cube = world.solids[0];
    EXPECT_EQ(cube.body.particle_count, 729);
    EXPECT_EQ(cube.body.vertex_count, 386);
    EXPECT_EQ(cube.cells.size(), 512u);
    EXPECT_EQ(world.vertex_count(), 729u + 386u);
    EXPECT_NEAR(mass_of(world), 0.71, 1e-14);
    // 3 * 8 * 81 sides, 3 * 9 * 64 * 2 diagonals of faces, 512 * 4 of cells.
    EXPECT_EQ(cube.network.size(), 1944u + 3456u + 2048u);
}

TEST(BuildSolid, StandsWhereItIsPlacedAtRest) {
    const World world = build(scene_of(k_cube()));
    const Solid& cube = world.solids[0];

    for (const NetworkEdge& edge : cube.network) {
        const auto x = [&](std::size_t k) {
            return world.positions[at(cube.body.first_particle + edge.vertices[k])];
        };
        EXPECT_NEAR((x(1) - x(0)).norm(), edge.rest_length, 1e-15);
    }
    const Vec3 corner = place(k_cube().placement, Vec3::Constant(-0.08));
    EXPECT_LT((world.positions[at(cube.body.first_particle)] - corner).norm(), 1e-15);
}

TEST(BuildSolid, ShearIsTheStiffnessOfDiagonalsOverThatOfSides) {
    SolidParams params = k_cube();
    params.spring.K = 300.0;
    params.spring.shear = 0.5;
    const World world = build(scene_of(params));
    for (const NetworkEdge& edge : world.solids[0].network) {
        EXPECT_EQ(edge.stiffness, edge.kind == EdgeKind::Side ? 300.0 : 150.0);
    }
    params.spring.shear = 0.0;
    EXPECT_EQ(build(scene_of(params)).solids[0].network.size(), 1944u);
}

TEST(BuildSolid, SurfaceOfAMeshIsCarriedInItsPlace) {
    SolidParams params{.name = "ring", .spacing = 0.1};
    params.placement = {{1.0, 2.0, 3.0}, {40.0, 50.0, 60.0}, 2.0};
    const TriangleMesh mesh = scaled(torus(0.4, 0.15, 30, 12), 0.5);
    const World world = build(params, mesh);
    const Body& body = world.solids[0].body;

    EXPECT_EQ(check(world), "");
    EXPECT_EQ(at(body.vertex_count), mesh.positions.size()); // no edge is long
    std::vector<Vec3> wanted;
    for (const Vec3& x : mesh.positions) {
        wanted.push_back(place(params.placement, x));
    }
    for (Index v = 0; v < body.vertex_count; ++v) {
        double nearest = 1.0; // the importer may number vertices anew
        for (const Vec3& x : wanted) {
            nearest = std::min(nearest, (x - world.positions[at(body.first_vertex + v)]).norm());
        }
        EXPECT_LT(nearest, 1e-6); // its coordinates are of single precision
    }
}

TEST(BuildSolid, FlatFacesGetVerticesToBendBy) {
    const World world = build({.name = "box", .spacing = 0.1}, cubes({{0, 0, 0}}));
    const Body& body = world.solids[0].body;

    EXPECT_GT(body.vertex_count, 6 * 49);
    for (const MeshEdge& edge : body.topology.edges) {
        EXPECT_FALSE(edge.is_boundary());
        EXPECT_LE((world.positions[at(edge.v[0])] - world.positions[at(edge.v[1])]).norm(),
                  0.15 + 1e-6);
    }
}

TEST(BuildSolid, MeshWoundInwardIsFilledAllTheSame) {
    TriangleMesh mesh = globe(0.5, 12, 8);
    for (Triangle& t : mesh.triangles) {
        std::swap(t[0], t[1]);
    }
    const World world = build({.name = "ball", .spacing = 0.2}, mesh);
    const Body& body = world.solids[0].body;
    TriangleMesh surface{{world.positions.begin(), world.positions.begin() + body.vertex_count},
                         body.triangles};

    EXPECT_NEAR(volume_of(surface), -volume_of(mesh), 1e-6);
}

TEST(BuildSolid, PartWithinAPartIsACavity) {
    TriangleMesh mesh = globe(0.5, 24, 12);
    const TriangleMesh inner = globe(0.3, 24, 12); // wound outward too
    const auto first = static_cast<Index>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), inner.positions.begin(), inner.positions.end());
    for (const Triangle& t : inner.triangles) {
        mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    const World world = build({.name = "shell", .spacing = 0.05}, mesh);
    const Body& body = world.solids[0].body;

    for (Index p = 0; p < body.particle_count; ++p) { // half a cell's diagonal inside of it at most
        EXPECT_GT(world.positions[at(body.first_particle + p)].norm(), 0.28 - 0.087);
    }
}

TEST(BuildSolid, OpenMeshIsRefusedAtItsEdgeUnlessFilledByWinding) {
    TriangleMesh mesh = globe(0.5, 24, 12);
    mesh.triangles.erase(mesh.triangles.begin());
    SolidParams params{.name = "bowl", .spacing = 0.1};

    const std::string message = refusal(params, mesh);
    EXPECT_NE(message.find("solid 'bowl': a.obj: is open at edge "), std::string::npos) << message;
    EXPECT_NE(message.find("and 2 more: must be closed, or fill = \"winding\""), std::string::npos);
    params.fills_open = true;
    EXPECT_EQ(check(build(params, mesh)), "");
}

TEST(BuildSolid, MeshThatCrossesItselfIsRefusedWithThePlace) {
    TriangleMesh mesh = globe(0.5, 12, 8);
    const auto first = static_cast<Index>(mesh.positions.size());
    const TriangleMesh other = globe(0.5, 12, 8);
    for (const Vec3& x : other.positions) {
        mesh.positions.push_back(x + Vec3(0.7, 0.01, 0.02));
    }
    for (const Triangle& t : other.triangles) {
        mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }

    const std::string message = refusal({.name = "twins", .spacing = 0.1}, mesh);

    EXPECT_NE(message.find("solid 'twins': a.obj: crosses itself: triangles "), std::string::npos);
    EXPECT_NE(message.find(" pairs more"), std::string::npos);
}

TEST(BuildSolid, FlatOpenMeshHasNothingInside) {
    const TriangleMesh sheet{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, {{0, 1, 2}}};

    EXPECT_NE(refusal({.name = "sheet", .fills_open = true, .spacing = 0.1}, sheet)
                  .find("has nothing inside"),
              std::string::npos);
}

TEST(BuildSolid, SpacingThatFillsTheMemoryIsRefused) {
    const std::string message = refusal({.name = "ball", .spacing = 1e-5}, globe(0.5, 12, 8));

    EXPECT_NE(message.find("spacing = 1e-05: must be at least 0.0022 m"), std::string::npos)
        << message;
}

TEST(BuildSolid, PinsHoldTheParticlesInTheirBox) {
    SolidParams params = k_cube();
    params.placement.rotate_deg = {0.0, 0.0, 0.0};
    PinParams pin;
    pin.has_box = true;
    pin.box_min = {-1.0, 0.9, -1.0};
    pin.box_max = {1.0, 0.93, 1.0};
    params.pins.push_back(pin);
    const World world = build(scene_of(params));

    EXPECT_EQ(world.pins.size(), 81u); // the lowest layer
    for (const Pin& held : world.pins) {
        EXPECT_GE(held.vertex, world.solids[0].body.first_particle);
        EXPECT_NEAR(held.start.y(), 0.92, 1e-12);
    }
    params.pins[0].box_min.y() = 2.0;
    params.pins[0].box_max.y() = 3.0;
    EXPECT_THROW(build(scene_of(params)), Error);
}

TEST(SplitEdges, KeepTheSurfaceAndItsVertices) {
    const TriangleMesh mesh = turned(torus(0.4, 0.15, 9, 5), 1);
    const TriangleMesh split = split_long_edges(mesh, 0.1);

    EXPECT_NEAR(volume_of(split), volume_of(mesh), 1e-14);
    EXPECT_TRUE(std::equal(mesh.positions.begin(), mesh.positions.end(), split.positions.begin()));
    for (const MeshEdge& edge : build_edges(split.triangles).edges) {
        EXPECT_FALSE(edge.is_boundary());
        EXPECT_LE((split.positions[at(edge.v[0])] - split.positions[at(edge.v[1])]).norm(), 0.1);
    }
}

} // namespace weft
