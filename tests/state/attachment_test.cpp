#include "base/error.h"
#include "scene/scene_reader.h"
#include "state/attachment.h"
#include "state/build_world.h"
#include "state/world.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// Two upright sheets of 0.4 m, 0.1 m apart in z, with `attach` tables after them.
std::string two_sheets(const std::string& attach, int cells_b = 4, double size_b = 0.4) {
    return fmt::format(R"(
[[cloth]]
name = "a"
grid = {{ size = [0.4, 0.4], cells = [4, 4] }}
rotate_deg = [90.0, 0.0, 0.0]
translate = [0.0, 0.0, 0.05]
[[cloth]]
name = "b"
grid = {{ size = [{1}, {1}], cells = [{0}, {0}] }}
rotate_deg = [90.0, 0.0, 0.0]
translate = [0.0, 0.0, -0.05]
)",
                       cells_b, size_b) +
           attach;
}

const std::string k_seam = R"(
[[attach]]
name = "side"
kind = "seam"
a = { cloth = "a", from = [0.2, -0.2, 0.05], to = [0.2, 0.2, 0.05] }
b = { cloth = "b", from = [0.2, -0.2, -0.05], to = [0.2, 0.2, -0.05] }
)";

World built(const std::string& text, std::vector<std::string>* warnings = nullptr) {
    return build_world(read_scene_text(text, "x.toml", "."), [&](const std::string& line) {
        ASSERT_NE(warnings, nullptr) << line;
        warnings->push_back(line);
    });
}

std::string refusal_of(const std::string& text) {
    try {
        built(text);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

double weight_sum(const AttachedPair& pair) {
    double sum = 0.0;
    for (const double w : pair.weights) {
        sum += w;
    }
    return sum;
}

} // namespace

TEST(Attachments, OfASeamJoinOppositeVertices) {
    const World world = built(two_sheets(k_seam));

    ASSERT_EQ(world.attached_pairs.size(), 5U);
    double limit = 0.0;
    for (const AttachedPair& pair : world.attached_pairs) {
        EXPECT_LT((pair_gap(pair, world.positions) - Vec3(0.0, 0.0, 0.1)).norm(), 1e-12);
        EXPECT_EQ(weight_sum(pair), 0.0);
        limit += pair.limit;
    }
    EXPECT_NEAR(limit, 20.0 * 0.4, 1e-12); // strength times length
    EXPECT_EQ(world.attachments[0].length[0], world.attachments[0].length[1]);
    EXPECT_EQ(check(world), "");
}

TEST(Attachments, OfASeamTieTheFinerBorderToTheCoarser) {
    const World world = built(two_sheets(k_seam, 6));

    ASSERT_EQ(world.attached_pairs.size(), 7U);
    for (const AttachedPair& pair : world.attached_pairs) {
        EXPECT_LT((pair_gap(pair, world.positions) - Vec3(0.0, 0.0, 0.1)).norm(), 1e-12);
    }
}

TEST(Attachments, WarnWhereTheSidesDifferInLength) {
    std::vector<std::string> warnings;

    built(two_sheets(k_seam, 4, 0.44), &warnings);

    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0], "attach 'side': side a is 0.4 m long and side b 0.44 m, 9.1 % apart: "
                           "the longer one will pucker");
}

TEST(Attachments, OfAButtonHoldNearestPointsAThicknessApart) {
    const World world = built(two_sheets(R"(
[[attach]]
name = "top"
kind = "button"
a = { cloth = "a", at = [0.03, 0.11, 0.05] }
b = { cloth = "b" }
radius = 0.2
)"));

    ASSERT_EQ(world.attached_pairs.size(), 1U);
    EXPECT_LT((pair_gap(world.attached_pairs[0], world.positions) - Vec3(0.0, 0.0, 0.1)).norm(),
              1e-12);
    EXPECT_EQ(world.attachments[0].rest_gap, 1e-3); // both fabrics' thickness
}

TEST(Attachments, LeaveOutThePointOfADart) {
    const World world = built(two_sheets(R"(
[[attach]]
name = "dart"
kind = "seam"
a = { cloth = "a", vertices = [12, 7] }
b = { cloth = "a", vertices = [12, 11] }
)"));

    EXPECT_EQ(world.attached_pairs.size(), 1U);
}

TEST(Attachments, RefuseAPlaceFarFromTheCloth) {
    EXPECT_EQ(refusal_of(two_sheets(R"(
[[attach]]
name = "top"
kind = "button"
a = { cloth = "a", at = [0.0, 0.0, 0.05] }
b = { cloth = "b" }
)")),
              "attach 'top'.b: the nearest point of 'b' is 0.1 m from (0, 0, 0.05) m: must be "
              "within radius, 0.05 m");
}

TEST(Attachments, NameTheNearestCloth) {
    const std::string text = two_sheets(R"(
[[attach]]
name = "top"
kind = "button"
a = { cloth = "aa", vertices = [1] }
b = { cloth = "b" }
)");

    EXPECT_NE(refusal_of(text).find("attach[0].a.cloth = \"aa\": must be the name of a cloth; the "
                                    "nearest is a"),
              std::string::npos)
        << refusal_of(text);
}

TEST(AllowedGap, FallsSmoothlyFromTheStartToTheRestGap) {
    const Attachment attachment{.start = 1.0, .close = 2.0, .rest_gap = 0.01};

    EXPECT_EQ(allowed_gap(attachment, 0.21, 0.5), 0.21);
    EXPECT_NEAR(allowed_gap(attachment, 0.21, 2.0), 0.11, 1e-15);
    EXPECT_NEAR(allowed_gap(attachment, 0.21, 3.0), 0.01, 1e-15);
    EXPECT_NEAR(allowed_gap(attachment, 0.21, 1.001), 0.21, 1e-6); // at rest at both ends
    EXPECT_EQ(allowed_gap(attachment, 0.005, 1.0), 0.01);
}

TEST(Attachments, BeginWeldAndLetGoInTheirTime) {
    World world = built(two_sheets(k_seam + "start = 0.5\nclose = 1.0\nuntil = 2.0\n"));
    const AttachedPair& pair = world.attached_pairs[0];
    const AttachedState& state = world.attached_states[0];
    const auto move_to = [&](double gap) {
        const auto v = static_cast<std::size_t>(pair.vertices[0]);
        const auto w = static_cast<std::size_t>(pair.vertices[1]);
        world.positions[v] = world.positions[w] + Vec3(0.0, 0.0, gap);
    };

    update_attachments(world, 0.4);
    EXPECT_LT(state.start_gap, 0.0);
    EXPECT_EQ(state.is_joined, 0);

    update_attachments(world, 0.5);
    EXPECT_NEAR(state.start_gap, 0.1, 1e-12);
    EXPECT_EQ(state.is_joined, 1);

    move_to(1e-4);
    update_attachments(world, 1.4);
    EXPECT_LT(state.welded_since, 0.0); // near, but the time to close is not over
    update_attachments(world, 1.5);
    EXPECT_EQ(state.welded_since, 1.5);
    world.time = 1.5;
    EXPECT_EQ(measure_attachments(world).welded, 1);

    update_attachments(world, 2.1);
    EXPECT_LT(state.welded_since, 0.0);
    EXPECT_EQ(state.is_joined, 1); // until contact has room for them as two
    move_to(1.1e-3);
    update_attachments(world, 2.2);
    EXPECT_EQ(state.is_joined, 0);
}

} // namespace weft
