#include "adapt/sqrt3_mesh.h"
#include "support/adaptive_cloths.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace weft {

namespace {

bool has_triangle(const Cloth& cloth, const Triangle& wanted) {
    return std::any_of(cloth.triangles.begin(), cloth.triangles.end(), [&](Triangle t) {
        for (int turn = 0; turn < 3; ++turn) {
            if (t == wanted) {
                return true;
            }
            std::rotate(t.begin(), t.begin() + 1, t.end());
        }
        return false;
    });
}

/// Two triangles, refined as far as both barycentres and the flip between them.
struct TwoTriangles {
    Cloth cloth = test::adaptive_sheet(one_diagonal_sheet(1, 1, 1.0, 1.0));
    Sqrt3Mesh mesh{cloth};

    void begin(AdaptationHooks hooks) {
        mesh.begin(cloth, std::move(hooks), {.max_level = 4, .adaptation = 7});
    }
};

} // namespace

TEST(AdaptationHooks, InsertedVerticesAreNamedWithParentsAndWeights) {
    TwoTriangles two;
    const Triangle parent = two.cloth.triangles[0];
    std::vector<VertexParents> inserted;
    two.begin({.insert = [&](const VertexParents& place) { inserted.push_back(place); }});

    two.mesh.refine(0); // its barycentre; one of the parts has the diagonal, two a boundary edge
    ASSERT_EQ(inserted.size(), 1u);
    const Index p = inserted[0].vertex;
    EXPECT_EQ(inserted[0].parents, parent);
    EXPECT_EQ(inserted[0].weights, (std::array{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}));
    EXPECT_EQ(two.cloth.refinement.inserted(p).anchor, parent[0]);
    EXPECT_EQ(two.cloth.refinement.inserted(p).born, 7);

    const auto on_boundary = std::find_if(
        two.cloth.triangles.begin(), two.cloth.triangles.end(), [&](const Triangle& t) {
            const auto i = static_cast<std::size_t>(&t - two.cloth.triangles.data());
            return t[0] == p &&
                   two.cloth.topology.edges[at(two.cloth.topology.triangle_edges[i][0])]
                       .is_boundary();
        });
    const Triangle cut = *on_boundary;
    two.mesh.refine(static_cast<Index>(on_boundary - two.cloth.triangles.begin()));

    ASSERT_EQ(inserted.size(), 3u);
    EXPECT_EQ(inserted[1].parents, (std::array{cut[1], cut[2], k_no_index}));
    EXPECT_EQ(inserted[1].weights, (std::array{2.0 / 3.0, 1.0 / 3.0, 0.0}));
    EXPECT_EQ(inserted[2].weights, (std::array{1.0 / 3.0, 2.0 / 3.0, 0.0}));
    two.mesh.finish();
}

TEST(AdaptationHooks, FlipIsAskedForWithTheEdgeAndItsApexes) {
    TwoTriangles two;
    std::vector<EdgeFlip> asked;
    two.begin({.may_flip = [&](const EdgeFlip& flip) {
        asked.push_back(flip);
        return false;
    }});

    two.mesh.refine(0);
    two.mesh.refine(1);

    ASSERT_EQ(asked.size(), 1u);
    const auto [a, b] = asked[0].edge;
    const auto [P, Q] = asked[0].apex;
    EXPECT_TRUE(has_triangle(two.cloth, {P, a, b}));
    EXPECT_TRUE(has_triangle(two.cloth, {Q, b, a}));
    EXPECT_GE(std::min(P, Q), 4);
    two.mesh.finish();
    EXPECT_EQ(two.cloth.refinement.pending_flips.size(), 1u);

    two.begin({});
    EXPECT_EQ(two.mesh.retry_flips(), 1);
    EXPECT_TRUE(has_triangle(two.cloth, {P, a, Q}));
    EXPECT_TRUE(has_triangle(two.cloth, {Q, b, P}));
    two.mesh.finish();
    EXPECT_TRUE(two.cloth.refinement.pending_flips.empty());
}

TEST(AdaptationHooks, RemovalIsDescribedBeforeAnythingOfItIsDone) {
    TwoTriangles two;
    const Triangle parent = two.cloth.triangles[0];
    two.begin({});
    two.mesh.refine(0);
    const Index p = two.cloth.vertex_count - 1;
    two.mesh.refine(1);
    two.mesh.finish();
    bool is_asked = false, is_told = false;
    two.begin({.may_remove =
                   [&](const Removal& removal) {
                       is_asked = true;
                       EXPECT_EQ(removal.flips.size(), 1u);
                       const auto [a, b] = removal.flips[0].edge;
                       const auto [P, Q] = removal.flips[0].apex;
                       EXPECT_TRUE(a == p || b == p);
                       EXPECT_TRUE(has_triangle(two.cloth, {P, a, b}));
                       EXPECT_TRUE(has_triangle(two.cloth, {Q, b, a}));
                       EXPECT_EQ(removal.vertices.size(), 1u);
                       EXPECT_EQ(removal.merged, (std::vector<Triangle>{parent}));
                       return true;
                   },
               .remove =
                   [&](const VertexParents& place) {
                       is_told = true;
                       EXPECT_EQ(place.vertex, p);
                       EXPECT_EQ(place.parents, parent);
                       EXPECT_FALSE(has_triangle(two.cloth, parent));
                   }});
    ASSERT_TRUE(two.mesh.can_remove(p));

    EXPECT_TRUE(two.mesh.remove(p));

    EXPECT_TRUE(is_asked && is_told);
    EXPECT_TRUE(has_triangle(two.cloth, parent));
    EXPECT_FALSE(two.mesh.can_remove(p));
    two.mesh.finish();
}

TEST(AdaptationHooks, ARefusedRemovalLeavesTheMeshAlone) {
    TwoTriangles two;
    two.begin({});
    two.mesh.refine(0);
    two.mesh.finish();
    const std::vector<Triangle> before = two.cloth.triangles;
    two.begin({.may_remove = [](const Removal&) { return false; },
               .remove = [](const VertexParents&) { FAIL(); }});

    EXPECT_FALSE(two.mesh.remove(4));

    EXPECT_TRUE(two.mesh.finish().empty());
    EXPECT_EQ(two.cloth.triangles, before);
}

TEST(AdaptationHooks, TheLastVertexTakesTheSlotOfOneRemoved) {
    TwoTriangles two;
    two.begin({});
    two.mesh.refine(0);
    two.mesh.refine(1);
    two.mesh.finish();
    std::vector<std::array<Index, 2>> moves;
    two.begin({.move = [&](Index from, Index to) { moves.push_back({from, to}); }});

    two.mesh.remove(4);
    const ClothChanges changes = two.mesh.finish();

    EXPECT_EQ(moves, (std::vector<std::array<Index, 2>>{{5, 4}}));
    ASSERT_EQ(changes.vertices.size(), 1u);
    EXPECT_EQ(changes.vertices[0].slot, 4);
    EXPECT_EQ(changes.vertices[0].from, 5);
    EXPECT_EQ(two.cloth.vertex_count, 5);
}

} // namespace weft
