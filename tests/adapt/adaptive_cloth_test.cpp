#include "adapt/adaptive_cloth.h"
#include "support/adaptive_cloths.h"
#include "support/mesh_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace weft {

namespace {

int locked_edges(const Cloth& cloth) {
    const auto& locked = cloth.refinement.locked;
    return std::accumulate(locked.begin(), locked.end(), 0);
}

/// Gives each triangle's material frame a turn of its own, up to `most` rad, and makes the mesh
/// adaptive anew.
void turn_frames(Cloth& cloth, double most, std::mt19937& random) {
    std::uniform_real_distribution<double> angle(-most, most);
    for (RestTriangle& rest : cloth.rest) {
        rest.inverse_edges *= Eigen::Rotation2Dd(angle(random)).toRotationMatrix();
    }
    make_refinement(cloth);
}

/// Angle of a flat cloth's triangle's material frame in its plane of material positions.
double frame_angle(const Cloth& cloth, std::size_t t) {
    const Vec2 in_frame = rest_corners(cloth.rest[t])[1];
    const Triangle& v = cloth.triangles[t];
    const Vec2 in_plane = cloth.material_positions[at(v[1])] - cloth.material_positions[at(v[0])];
    return std::atan2(in_frame.x() * in_plane.y() - in_frame.y() * in_plane.x(),
                      in_frame.dot(in_plane));
}

} // namespace

TEST(MakeRefinement, LocksNothingInAFlatClothOfOneGrain) {
    EXPECT_EQ(locked_edges(test::adaptive_sheet(test::rough_sheet(6, 0.25, 1))), 0);
}

TEST(MakeRefinement, LocksNothingInATubeWithTheGrainAlongIt) {
    EXPECT_EQ(locked_edges(test::adaptive_cylinder(12, 3)), 0);
}

TEST(MakeRefinement, LocksWhereTheGrainJumps) {
    // Lying, warp is y laid onto each triangle: it points along the tube in the level ones on top
    // and below, where there is no y in the plane, and around it beside them.
    const Cloth cloth = test::adaptive_cylinder(36, 2, true);

    EXPECT_GT(locked_edges(cloth), 0);
    EXPECT_LT(locked_edges(cloth), 36);
    for (std::size_t e = 0; e < cloth.topology.edges.size(); ++e) {
        EXPECT_TRUE(cloth.refinement.locked[e] == 0 || !cloth.topology.edges[e].is_boundary());
    }
}

TEST(MakeRefinement, LocksWhereTwoLengthsAreSewnTogether) {
    Cloth cloth = test::adaptive_sheet(one_diagonal_sheet(1, 1, 1.0, 1.0));
    for (const auto& [factor, expected] : {std::pair{1.0 + 1e-7, 0}, std::pair{1.01, 1}}) {
        Cloth sewn = cloth;
        sewn.rest[0].inverse_edges /= factor;
        sewn.rest[0].area *= factor * factor;

        make_refinement(sewn);

        EXPECT_EQ(locked_edges(sewn), expected) << factor;
    }
}

TEST(MakeRefinement, GrainsNearerThanTheLimitMayBeFlipped) {
    const double limit = k_same_grain_deg * std::numbers::pi / 180.0;
    for (const auto& [turn, expected] : {std::pair{0.99 * limit, 0}, std::pair{1.01 * limit, 1}}) {
        Cloth cloth = test::adaptive_sheet(one_diagonal_sheet(1, 1, 1.0, 1.0));
        cloth.rest[0].inverse_edges *= Eigen::Rotation2Dd(turn).toRotationMatrix();

        make_refinement(cloth);

        EXPECT_EQ(locked_edges(cloth), expected) << turn;
    }
}

TEST(MakeRefinement, RefinedRestShapesAreThoseOfThePlaneWhateverTheirFrames) {
    const double limit = k_same_grain_deg * std::numbers::pi / 180.0;
    std::mt19937 random(5);
    for (unsigned seed = 0; seed < 10; ++seed) {
        Cloth cloth = test::adaptive_sheet(test::rough_sheet(3, 0.2, seed));
        turn_frames(cloth, 0.49 * limit, random);
        ASSERT_EQ(locked_edges(cloth), 0);
        test::MeshHistory history(cloth, seed);

        history.run(6, 20, 0.8);

        ASSERT_GT(history.cloth.triangles.size(), 2 * cloth.triangles.size());
        for (std::size_t t = 0; t < history.cloth.triangles.size(); ++t) {
            const Triangle& v = history.cloth.triangles[t];
            for (std::size_t k = 0; k < 3; ++k) {
                const double length = (history.cloth.material_positions[at(v[(k + 1) % 3])] -
                                       history.cloth.material_positions[at(v[(k + 2) % 3])])
                                          .norm();
                EXPECT_NEAR(rest_edge_length(history.cloth.rest[t], static_cast<int>(k)), length,
                            1e-12);
            }
            EXPECT_LT(std::abs(frame_angle(history.cloth, t)), 0.49 * limit);
        }
    }
}

TEST(MakeRefinement, ATubeUnfoldsIntoItsOwnLengths) {
    // Twelve flat faces, each 2 sin(15 deg) wide: unrolled, every part is a flat strip's.
    const Cloth cloth = test::adaptive_cylinder(12, 3);
    test::MeshHistory history(cloth, 1);
    history.refine_all();
    history.refine_all();
    test::MeshHistory flat(test::adaptive_sheet(one_diagonal_sheet(
                               12, 3, 24.0 * std::sin(std::numbers::pi / 12.0), 1.0)),
                           1);
    flat.refine_all();
    flat.refine_all();

    const auto lengths = [](const Cloth& c) { // least, median, greatest
        std::vector<double> all;
        for (std::size_t t = 0; t < c.triangles.size(); ++t) {
            for (int k = 0; k < 3; ++k) {
                all.push_back(rest_edge_length(c.rest[t], k));
            }
        }
        std::sort(all.begin(), all.end());
        return std::array{all.front(), all[all.size() / 2], all.back()};
    };
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(lengths(history.cloth)[i], lengths(flat.cloth)[i], 1e-12);
    }
    EXPECT_EQ(history.cloth.triangles.size(), flat.cloth.triangles.size());
}

} // namespace weft
