#include "base/error.h"
#include "state/seam_chain.h"
#include "support/sheets.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

namespace weft {

using namespace test;

namespace {

/// A sheet of 4 x 4 cells and side 1 m, lying in x-z, whose vertices count along x first.
struct SeamSheet {
    World world;

    SeamSheet() {
        ClothParams sheet = record_sheet(4);
        world = build_quietly(scene_of(sheet));
    }
    SeamChain chain(const AttachSide& side) const {
        return build_seam_chain(world.cloths[0], side, 0.05, "attach 'x'.a", world.positions);
    }
    const Vec3& at(Index v) const { return world.positions[static_cast<std::size_t>(v)]; }
};

AttachSide border(VertexChoice from, VertexChoice to) {
    AttachSide side;
    side.from = from;
    side.to = to;
    return side;
}

SeamChain straight(const std::vector<double>& along) {
    SeamChain chain{{}, along};
    for (std::size_t i = 0; i < along.size(); ++i) {
        chain.vertices.push_back(static_cast<Index>(i));
    }
    return chain;
}

} // namespace

TEST(SeamChain, RunsTheShorterWayRoundTheBorder) {
    const SeamSheet sheet;

    const SeamChain chain =
        sheet.chain(border({.place = Vec3(-0.5, 0.0, -0.5)}, {.place = Vec3(0.25, 0.01, -0.5)}));

    ASSERT_EQ(chain.vertices.size(), 4U);
    EXPECT_NEAR(chain.length(), 0.75, 1e-12);
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 expected(-0.5 + 0.25 * static_cast<double>(i), 0.0, -0.5);
        EXPECT_LT((sheet.at(chain.vertices[i]) - expected).norm(), 1e-12);
    }
}

TEST(SeamChain, RunsTheWayThatViaNames) {
    const SeamSheet sheet;
    AttachSide side = border({.place = Vec3(-0.5, 0.0, -0.5)}, {.place = Vec3(0.25, 0.0, -0.5)});
    side.via = VertexChoice{.place = Vec3(0.0, 0.0, 0.5)};

    const SeamChain chain = sheet.chain(side);

    EXPECT_EQ(chain.vertices.size(), 14U); // 16 vertices on the border, two of them left out
    EXPECT_NEAR(chain.length(), 4.0 - 0.75, 1e-12);
}

TEST(SeamChain, IsMeasuredAtRest) {
    SeamSheet sheet;
    for (Vec3& x : sheet.world.positions) {
        x *= 1.1;
    }

    const SeamChain chain =
        sheet.chain(border({.place = Vec3(-0.55, 0.0, -0.55)}, {.place = Vec3(0.55, 0.0, -0.55)}));

    EXPECT_NEAR(chain.length(), 1.0, 1e-12);
}

TEST(SeamChain, RefusesWhatIsNoBorder) {
    const SeamSheet sheet;
    const VertexChoice corner{.place = Vec3(-0.5, 0.0, -0.5)};
    const auto refusal = [&](const AttachSide& side) -> std::string {
        try {
            sheet.chain(side);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };

    EXPECT_EQ(refusal(border(corner, {.place = Vec3(0.0, 0.0, 0.0)})),
              "attach 'x'.a.to = (0, 0, 0) m: must be within radius, 0.05 m, of a border vertex");
    EXPECT_EQ(refusal(border(corner, {.vertex = 12})),
              "attach 'x'.a.to = 12: must be a vertex on the border");
    EXPECT_EQ(refusal(border(corner, {.vertex = 25})),
              "attach 'x'.a.to: 25: must be 0 to 24 (vertices after welding)");
    EXPECT_EQ(refusal(border(corner, corner)),
              "attach 'x'.a: from and to: must be two vertices of one border, and are the same "
              "vertex");
}

TEST(SeamMatch, OfEqualChainsIsVertexByVertex) {
    const SeamChain a = straight({0.0, 0.1, 0.2, 0.3});
    const SeamChain b = straight({0.0, 0.13, 0.23, 0.33});

    const auto matches = match_chains(a, b);

    ASSERT_EQ(matches.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(matches[i].vertex, i);
        EXPECT_EQ(static_cast<double>(matches[i].segment) + matches[i].weight,
                  static_cast<double>(i));
    }
}

TEST(SeamMatch, OfUnequalChainsKeepsTheShareOfTheLength) {
    const SeamChain fine = straight({0.0, 0.1, 0.2, 0.3, 0.4});
    const SeamChain coarse = straight({0.0, 0.25, 0.375, 0.5});

    for (const SeamMatch& match : match_chains(fine, coarse)) {
        const double along = (1.0 - match.weight) * coarse.along[match.segment] +
                             match.weight * coarse.along[match.segment + 1];
        EXPECT_NEAR(along / 0.5, fine.along[match.vertex] / 0.4, 1e-12);
    }
}

TEST(SeamMatch, MovesAlmostVerticesOntoVertices) {
    const SeamChain fine = straight({0.0, 0.1, 0.205, 0.3, 0.4});
    const SeamChain coarse = straight({0.0, 0.2, 0.4});

    const SeamMatch middle = match_chains(fine, coarse)[2];

    EXPECT_EQ(middle.segment, 1U);
    EXPECT_EQ(middle.weight, 0.0);
}

} // namespace weft
