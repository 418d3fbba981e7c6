#include "collide/contact_surface.h"
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

} // namespace weft
