#include "frames/mesh_state.h"
#include "remesh/adapt_world.h"
#include "state/build_world.h"
#include "support/adapting_world.h"
#include "support/grid_world.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

using test::AdaptingWorld;
using test::SheetMotion;

/// Three sheets, of which the first and the last are refined, so that the others' vertices have
/// moved along; and the same as they start.
struct Sheets {
    AdaptingWorld refined{SheetMotion::Wave, 3};
    World start = refined.world;

    Sheets() {
        for (int i = 0; i < 4; ++i) {
            refined.adapt(0, 30, 0.9);
            refined.adapt(2, 30, 0.9);
        }
        refined.world.cloths[2].refinement.tolerance = 1.21;
    }
};

void expect_same_mesh(const Cloth& a, const Cloth& b) {
    EXPECT_EQ(a.first_vertex, b.first_vertex);
    EXPECT_EQ(a.vertex_count, b.vertex_count);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.topology.triangle_edges, b.topology.triangle_edges);
    ASSERT_EQ(a.topology.edges.size(), b.topology.edges.size());
    for (std::size_t e = 0; e < a.topology.edges.size(); ++e) {
        EXPECT_EQ(a.topology.edges[e].v, b.topology.edges[e].v);
        EXPECT_EQ(a.topology.edges[e].triangle, b.topology.edges[e].triangle);
        EXPECT_EQ(a.topology.edges[e].apex, b.topology.edges[e].apex);
    }
    ASSERT_EQ(a.rest.size(), b.rest.size());
    for (std::size_t t = 0; t < a.rest.size(); ++t) {
        EXPECT_EQ(a.rest[t].inverse_edges, b.rest[t].inverse_edges);
        EXPECT_EQ(a.rest[t].area, b.rest[t].area);
    }
    EXPECT_EQ(a.material_positions, b.material_positions);
    EXPECT_EQ(a.rest_areas, b.rest_areas);
}

void expect_same_records(const Refinement& a, const Refinement& b) {
    EXPECT_EQ(a.base_vertices, b.base_vertices);
    EXPECT_EQ(a.adaptations, b.adaptations);
    EXPECT_EQ(a.tolerance, b.tolerance);
    EXPECT_EQ(a.locked, b.locked);
    EXPECT_EQ(a.frozen, b.frozen);
    EXPECT_EQ(a.pending_flips, b.pending_flips);
    EXPECT_EQ(a.start, b.start);
    ASSERT_EQ(a.triangles.size(), b.triangles.size());
    for (std::size_t t = 0; t < a.triangles.size(); ++t) {
        EXPECT_EQ(a.triangles[t].generation, b.triangles[t].generation);
        EXPECT_EQ(a.triangles[t].parts, b.triangles[t].parts);
    }
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    for (std::size_t v = 0; v < a.vertices.size(); ++v) {
        EXPECT_EQ(a.vertices[v].parent_rest, b.vertices[v].parent_rest);
        EXPECT_EQ(a.vertices[v].partner, b.vertices[v].partner);
        EXPECT_EQ(a.vertices[v].born, b.vertices[v].born);
    }
}

TEST(MeshState, GivesBackEveryClothAndWhatNamesItsVertices) {
    Sheets sheets;
    const World& refined = sheets.refined.world;
    World read = sheets.start;
    ASSERT_NE(read.cloths[2].first_vertex, refined.cloths[2].first_vertex);

    ASSERT_EQ(decode_meshes(encode_meshes(refined), read), "");

    for (std::size_t c = 0; c < refined.cloths.size(); ++c) {
        expect_same_mesh(read.cloths[c], refined.cloths[c]);
        expect_same_records(read.cloths[c].refinement, refined.cloths[c].refinement);
    }
    EXPECT_EQ(read.masses, refined.masses);
    ASSERT_EQ(read.pins.size(), refined.pins.size());
    for (std::size_t i = 0; i < read.pins.size(); ++i) {
        EXPECT_EQ(read.pins[i].vertex, refined.pins[i].vertex);
        EXPECT_EQ(read.pins[i].start, refined.pins[i].start);
        EXPECT_EQ(read.pins[i].group, refined.pins[i].group);
    }
    ASSERT_EQ(read.attached_pairs.size(), refined.attached_pairs.size());
    for (std::size_t i = 0; i < read.attached_pairs.size(); ++i) {
        EXPECT_EQ(read.attached_pairs[i].vertices, refined.attached_pairs[i].vertices);
    }
}

TEST(MeshState, IsReadIntoAWorldOfAnyRefinement) {
    Sheets sheets;
    const std::string bytes = encode_meshes(sheets.refined.world);
    World read = sheets.start;
    ASSERT_EQ(decode_meshes(bytes, read), "");

    ASSERT_EQ(decode_meshes(encode_meshes(sheets.start), read), ""); // back

    EXPECT_EQ(encode_meshes(read), encode_meshes(sheets.start));
    EXPECT_EQ(read.cloths[2].first_vertex, sheets.start.cloths[2].first_vertex);
    for (std::size_t i = 0; i < read.attached_pairs.size(); ++i) {
        EXPECT_EQ(read.attached_pairs[i].vertices, sheets.start.attached_pairs[i].vertices);
    }
}

TEST(MeshState, PinsKeepTheirPlacesOnObstacles) {
    Sheets sheets;
    World world = sheets.refined.world;
    world.pins[1].anchor = {
        .obstacle = 2, .triangle = 7, .weights = {0.2, 0.3, 0.5}, .offset = {1e-3, -2e-3, 3e-3}};
    World read = sheets.start;

    ASSERT_EQ(decode_meshes(encode_meshes(world), read), "");

    EXPECT_EQ(read.pins[1].anchor.obstacle, 2);
    EXPECT_EQ(read.pins[1].anchor.triangle, 7);
    EXPECT_EQ(read.pins[1].anchor.weights, world.pins[1].anchor.weights);
    EXPECT_EQ(read.pins[1].anchor.offset, world.pins[1].anchor.offset);
    EXPECT_EQ(read.pins[0].anchor.obstacle, k_no_index);
}

TEST(MeshState, IsNothingWhereNothingAdapts) {
    World plain = test::grid_world(1.0, 3);

    EXPECT_EQ(encode_meshes(plain), "");
    EXPECT_EQ(decode_meshes("", plain), "");
    EXPECT_NE(decode_meshes(encode_meshes(Sheets().refined.world), plain), "");
}

TEST(MeshState, IsRefusedAtEveryTruncation) {
    Sheets sheets;
    const std::string bytes = encode_meshes(sheets.refined.world);

    for (std::size_t length = 0; length < bytes.size(); length += length < 64 ? 1 : 97) {
        World read = sheets.start;
        EXPECT_NE(decode_meshes(std::string_view(bytes).substr(0, length), read), "") << length;
    }
    World read = sheets.start;
    EXPECT_NE(decode_meshes(bytes + "x", read), "");
}

TEST(MeshState, OfAnotherMeshIsRefused) {
    Scene scene = test::grid_scene(1.0, 5);
    scene.cloths[0].adapt.levels = 2;
    World five = build_world(scene, [](const std::string&) {});
    scene.cloths[0].grid_cells = {3, 3};
    World three = build_world(scene, [](const std::string&) {});
    make_adaptive(five);
    make_adaptive(three);
    const std::string bytes = encode_meshes(three);

    EXPECT_NE(decode_meshes(bytes, five), "");

    // lengths that do not fit each other: the first length says one triangle less
    std::string damaged = encode_meshes(three);
    --damaged[0];
    damaged.erase(8, sizeof(Triangle));
    EXPECT_NE(decode_meshes(damaged, three), "");
}

} // namespace
} // namespace weft
