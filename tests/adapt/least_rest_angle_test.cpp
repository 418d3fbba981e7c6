#include "adapt/least_rest_angle.h"
#include "adapt/sqrt3_mesh.h"
#include "support/adaptive_cloths.h"
#include "support/mesh_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace weft {

namespace {

constexpr double k_degree = std::numbers::pi / 180.0;
constexpr double k_rounding = 1e-9; // rad

/// The same by looking at all triangles: each pass cuts every triangle once and lets no flip be
/// made before the next, so that none is there unseen.
double least_angle_seen(Cloth cloth, Index levels) {
    Sqrt3Mesh mesh(cloth);
    double least = least_rest_angle(cloth);
    for (std::size_t before = 0; before != cloth.triangles.size();) {
        before = cloth.triangles.size();
        mesh.begin(cloth, {.may_flip = [](const EdgeFlip&) { return false; }},
                   {.max_level = levels});
        const auto found = cloth.refinement.triangles;
        for (std::size_t t = 0; t < before; ++t) {
            if (cloth.refinement.triangles[t].generation == found[t].generation) {
                mesh.refine(static_cast<Index>(t));
            }
        }
        mesh.finish();
        least = std::min(least, least_rest_angle(cloth));
        mesh.begin(cloth, {}, {.max_level = levels});
        mesh.retry_flips();
        mesh.finish();
        least = std::min(least, least_rest_angle(cloth));
    }
    return least;
}

} // namespace

TEST(LeastRestAngle, OfOneTriangleIsThatOfItsLeastCorner) {
    const Cloth cloth = test::adaptive_sheet({{Vec2(0, 0), Vec2(3, 0), Vec2(3, 4)}, {{0, 1, 2}}});

    EXPECT_NEAR(least_rest_angle(cloth), std::atan2(3.0, 4.0), 1e-14);
}

TEST(LeastRestAngle, RefinedIsHalfOfAnEquilateralTriangles) {
    const Cloth cloth = test::adaptive_sheet(equilateral_sheet(2, 3, 0.1));

    EXPECT_NEAR(least_refined_angle(cloth, 0), 60.0 * k_degree, k_rounding);
    for (Index levels = 1; levels <= 4; ++levels) {
        EXPECT_NEAR(least_refined_angle(cloth, levels), 30.0 * k_degree, k_rounding);
    }
}

TEST(LeastRestAngle, RefinedIsThatOfRightAngledTriangles) {
    for (const Sheet& sheet :
         {one_diagonal_sheet(3, 2, 1.5, 1.0), union_jack_sheet(2, 2, 1.0, 1.0)}) {
        const Cloth cloth = test::adaptive_sheet(sheet);

        EXPECT_NEAR(least_refined_angle(cloth, 0), 45.0 * k_degree, k_rounding);
        for (Index levels = 1; levels <= 4; ++levels) {
            EXPECT_NEAR(least_refined_angle(cloth, levels), std::atan(1.0 / 3.0), k_rounding);
        }
    }
}

TEST(LeastRestAngle, RefinedIsOfAllTrianglesThatAreEverThere) {
    for (unsigned seed = 0; seed < 18; ++seed) {
        SCOPED_TRACE(seed);
        const Cloth cloth = test::some_cloth(seed);
        for (Index levels = 1; levels <= 3; ++levels) {
            EXPECT_NEAR(least_refined_angle(cloth, levels), least_angle_seen(cloth, levels),
                        k_rounding);
        }
    }
}

TEST(LeastRestAngle, NoHistoryGoesBelowTheRefined) {
    for (unsigned seed = 0; seed < 90 && !HasFailure(); ++seed) {
        SCOPED_TRACE(seed);
        const Cloth start =
            seed % 10 == 9
                ? test::adaptive_sheet(irregular_sheet(3, 3, 1.0, 1.0, 0.3, seed)) // Delaunay
                : test::some_cloth(seed);
        const double bound = least_refined_angle(start, 4);
        test::MeshHistory history(start, seed, 4);
        history.refuse(seed % 2 == 0 ? 0.0 : 0.4);
        for (int i = 0; i < 10; ++i) {
            history.run(1, 10, 0.7);
            EXPECT_GE(least_rest_angle(history.cloth), bound - k_rounding);
        }
    }
}

TEST(LeastRestAngle, RefinedIsTheSameWhateverIsRefinedAlready) {
    for (unsigned seed = 0; seed < 18; ++seed) {
        const Cloth start = test::some_cloth(seed);
        test::MeshHistory history(start, seed, 3);
        history.refuse(0.3);

        history.run(3, 10, 0.8);

        EXPECT_NEAR(least_refined_angle(history.cloth, 3), least_refined_angle(start, 3),
                    k_rounding);
    }
}

} // namespace weft
