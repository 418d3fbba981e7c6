#include "collide/broad_phase.h"
#include "collide/contact_surface.h"
#include "collide/crossings.h"
#include "support/contact_world.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {

namespace {

/// Two sheets above a floor, kinetic and static friction of each, and what they agree on.
class FrictionOfPairs : public testing::Test {
protected:
    FrictionOfPairs() {
        test::add_sheet(world_, 1, 0.1, 0.0, fabric(0.2, 0.5)).name = "shirt";
        test::add_sheet(world_, 1, 0.1, 0.1, fabric(0.8, std::nullopt)).name = "coat";
        Obstacle& floor = test::add_floor(world_, 1.0, -1.0);
        floor.name = "floor";
        floor.params.friction = 0.1;
        floor.params.static_friction = 0.4;
    }

    static FabricParams fabric(double kinetic, std::optional<double> at_rest) {
        FabricParams result;
        result.friction = kinetic;
        result.static_friction = at_rest;
        return result;
    }

    /// Of objects by number: shirt, coat, floor.
    PairRule rule(std::size_t a, std::size_t b) const {
        return make_surface(world_, contact_).rules[3 * a + b];
    }

    World world_;
    ContactParams contact_;
};

} // namespace

TEST_F(FrictionOfPairs, IsTheRootOfTheProduct) {
    EXPECT_DOUBLE_EQ(rule(0, 1).friction, std::sqrt(0.2 * 0.8));
    EXPECT_DOUBLE_EQ(rule(0, 1).static_friction, std::sqrt(0.5 * 0.8));
    EXPECT_DOUBLE_EQ(rule(2, 0).friction, std::sqrt(0.1 * 0.2));
    EXPECT_DOUBLE_EQ(rule(2, 0).static_friction, std::sqrt(0.4 * 0.5));
}

TEST_F(FrictionOfPairs, IsTheTablesInEitherOrder) {
    contact_.friction = {{{"floor", "shirt"}, 0.6, 0.7}, {{"coat", "coat"}, 0.9, std::nullopt}};

    for (const PairRule& found : {rule(0, 2), rule(2, 0)}) {
        EXPECT_EQ(found.friction, 0.6);
        EXPECT_EQ(found.static_friction, 0.7);
    }
    EXPECT_EQ(rule(1, 1).static_friction, 0.9);
    EXPECT_DOUBLE_EQ(rule(0, 0).friction, 0.2); // the table speaks of the coat with itself alone
    EXPECT_DOUBLE_EQ(rule(2, 1).friction, std::sqrt(0.1 * 0.8));
}

TEST(ContactThickness, IsLoweredWhereTheMeshIsFineAlone) {
    World world;
    FabricParams fabric;
    fabric.thickness = 4e-3;
    Cloth& sheet = test::add_sheet(world, 4, 0.4, 0.0, fabric); // right angles, legs of 0.1 m
    RestTriangle& thin = sheet.rest.front();
    thin.inverse_edges.row(1) *= 100.0; // 1 mm high over its first side of 0.1 m
    thin.area /= 100.0;
    const ContactSurface surface = make_surface(world);

    const Triangle& corners = sheet.triangles.front();
    for (Index v = 0; v < sheet.vertex_count; ++v) {
        const bool is_corner = std::find(corners.begin(), corners.end(), v) != corners.end();
        EXPECT_LE(surface.self_thickness[static_cast<std::size_t>(v)], is_corner ? 0.5e-3 : 4e-3);
        EXPECT_GE(surface.self_thickness[static_cast<std::size_t>(v)], is_corner ? 0.3e-3 : 4e-3);
    }
    const Triangle& far = sheet.triangles.back();
    EXPECT_DOUBLE_EQ(surface.thickness_of({far[0], far[1], far[2], far[0]}, PairKind::VertexFace),
                     4e-3);
    EXPECT_LT(
        surface.thickness_of({far[0], corners[0], corners[1], corners[2]}, PairKind::VertexFace),
        0.5 * (4e-3 + 0.5e-3) + 1e-12);
}

namespace {

/// Two sheets of 4 x 4 cells sewn along x = 0, where their borders are the same line; the second
/// one stands upright, so that sides of one end in the other.
struct SewnSheets {
    World world;

    SewnSheets() {
        for (int side = 0; side < 2; ++side) {
            const Cloth& sheet = test::add_sheet(world, 4, 0.4, 0.0, {});
            for (Index v = sheet.first_vertex; v < sheet.first_vertex + sheet.vertex_count; ++v) {
                Vec3& x = at(v);
                x = side == 0 ? Vec3(x.x() - 0.2, 0.0, x.z()) : Vec3(0.0, x.x() + 0.2, x.z());
            }
        }
        world.attachments.push_back({.name = "seam"});
        for (Index v = 0; v < 25; ++v) {
            for (Index w = 25; w < 50; ++w) {
                if ((at(v) - at(w)).norm() < 1e-9) {
                    world.attached_pairs.push_back(
                        {.vertices = {v, w, k_no_index, k_no_index, k_no_index, k_no_index},
                         .weights = {1.0, -1.0, 0.0, 0.0, 0.0, 0.0},
                         .attachment = 0,
                         .limit = 1.0});
                    at(w) = at(v); // to the bit
                }
            }
        }
        set_joined(true);
    }
    Vec3& at(Index v) { return world.positions[static_cast<std::size_t>(v)]; }
    void set_joined(bool joined) {
        world.attached_states.assign(world.attached_pairs.size(), {.is_joined = joined ? 1 : 0});
    }
};

} // namespace

TEST(JoinedVertices, AreFoundFromBothSides) {
    const SewnSheets sheets;
    const ContactSurface surface = make_surface(sheets.world);

    ASSERT_EQ(sheets.world.attached_pairs.size(), 5U);
    for (const AttachedPair& pair : sheets.world.attached_pairs) {
        EXPECT_TRUE(surface.are_one(pair.vertices[0], pair.vertices[1]));
        EXPECT_TRUE(surface.are_one(pair.vertices[1], pair.vertices[0]));
        EXPECT_FALSE(surface.are_one(pair.vertices[0], pair.vertices[1] == 49 ? 48 : 49));
    }
}

TEST(JoinedVertices, AtASeamDoNotCountAsCrossing) {
    SewnSheets sheets;
    EXPECT_TRUE(find_crossings(sheets.world, 100).empty());

    sheets.set_joined(false);
    EXPECT_FALSE(find_crossings(sheets.world, 100).empty()); // what touches counts
}

TEST(JoinedVertices, LetNoTrueCrossingBesideASeamPass) {
    SewnSheets sheets;
    // the far border of the upright sheet is folded down through the lying one
    for (Index w = 25; w < 50; ++w) {
        Vec3& x = sheets.at(w);
        if (x.y() > 0.35) {
            x = Vec3(-0.15, -0.05, x.z());
        }
    }

    EXPECT_FALSE(find_crossings(sheets.world, 100).empty());
}

TEST(JoinedVertices, MakeNoContactWithEachOther) {
    SewnSheets sheets;
    const auto count_joined = [&] {
        ContactSurface surface = make_surface(sheets.world);
        const std::vector<Vec3> still(50, Vec3::Zero());
        place_surface(surface, sheets.world, still, std::vector<char>(50, 0), 0.01);
        BroadPhase broad_phase(surface, true);
        std::vector<Candidate> candidates;
        broad_phase.find(surface, 0.01, candidates);
        std::size_t count = 0;
        for (const Candidate& candidate : candidates) {
            const auto& v = candidate.vertices;
            const std::size_t split = first_side(candidate.kind);
            for (std::size_t i = 0; i < split; ++i) {
                for (std::size_t j = split; j < 4; ++j) {
                    count += (sheets.at(v[i]) - sheets.at(v[j])).norm() < 1e-9 ? 1 : 0;
                }
            }
        }
        return count;
    };

    EXPECT_EQ(count_joined(), 0U);
    sheets.set_joined(false);
    EXPECT_GT(count_joined(), 0U);
}

} // namespace weft
