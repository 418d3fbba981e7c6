#include "adapt/rest_split.h"
#include "adapt/sqrt3_mesh.h"
#include "support/adaptive_cloths.h"
#include "support/mesh_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace weft {

namespace {

using Corners = std::array<Vec2, 3>;

RestTriangle rest_of(const Corners& m, double frame_angle = 0.0) {
    const Mat2 into_frame = Eigen::Rotation2Dd(-frame_angle).toRotationMatrix();
    const Vec2 e1 = into_frame * (m[1] - m[0]);
    const Vec2 e2 = into_frame * (m[2] - m[0]);
    const double det = e1.x() * e2.y() - e1.y() * e2.x();
    Mat2 inverse;
    inverse << e2.y(), -e2.x(), -e1.y(), e1.x();
    return {Mat2(inverse / det), 0.5 * det};
}

void expect_near(const RestTriangle& a, const RestTriangle& b) {
    EXPECT_LT((a.inverse_edges - b.inverse_edges).norm(), 1e-12 * b.inverse_edges.norm());
    EXPECT_NEAR(a.area, b.area, 1e-12 * b.area);
}

/// Counter-clockwise and not too thin.
Corners random_triangle(std::mt19937& random) {
    std::uniform_real_distribution<double> shift(-0.3, 0.3);
    Corners m{Vec2(0, 0), Vec2(1, 0), Vec2(0.4, 0.9)};
    for (Vec2& corner : m) {
        corner += Vec2(shift(random), shift(random));
    }
    return m;
}

/// Triangles (P, a, b) and (Q, b, a) of a convex quadrilateral.
struct Pair {
    Vec2 P, Q, a, b;
};

Pair random_pair(std::mt19937& random) {
    std::uniform_real_distribution<double> shift(-0.2, 0.2);
    const auto near = [&](double x, double y) {
        return Vec2(x + shift(random), y + shift(random));
    };
    return {near(0, 1), near(0, -1), near(-1, 0), near(1, 0)};
}

} // namespace

TEST(RestSplit, PartsAreThoseOfTheTriangleInThePlane) {
    std::mt19937 random(1);
    for (int i = 0; i < 100; ++i) {
        const Corners m = random_triangle(random);
        const Vec2 centre = (m[0] + m[1] + m[2]) / 3.0;
        for (std::uint32_t k = 0; k < 3; ++k) {
            expect_near(split_rest(rest_of(m), k), rest_of({centre, m[k], m[(k + 1) % 3]}));
        }
        const auto& [P, a, b] = m;
        const Vec2 v1 = a + (b - a) / 3.0;
        const Vec2 v2 = b + (a - b) / 3.0;
        expect_near(trisect_rest(rest_of(m), 0), rest_of({P, v1, v2}));
        expect_near(trisect_rest(rest_of(m), 1), rest_of({v1, P, a}));
        expect_near(trisect_rest(rest_of(m), 2), rest_of({v2, b, P}));
    }
}

TEST(RestSplit, FlipTakesTheMeanOfTheMaterialFrames) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> angle(-0.2, 0.2);
    for (int i = 0; i < 100; ++i) {
        const auto [P, Q, a, b] = random_pair(random);
        const double first = angle(random);
        const double second = i == 0 ? first : angle(random);

        const RestFlip flip = flip_rest(rest_of({P, a, b}, first), rest_of({Q, b, a}, second));

        expect_near(flip.rest[0], rest_of({P, a, Q}, 0.5 * (first + second)));
        expect_near(flip.rest[1], rest_of({Q, b, P}, 0.5 * (first + second)));
        EXPECT_NEAR(frame_turn(rest_of({P, a, b}, first), 0, rest_of({Q, b, a}, second), 0),
                    second - first, 1e-12);
    }
}

TEST(RestSplit, FlipIsTheSameFromBothSides) {
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
        const auto [P, Q, a, b] = random_pair(random);
        const RestTriangle first = rest_of({P, a, b}, 0.1);
        const RestTriangle second = rest_of({Q, b, a}, -0.03);

        const RestFlip flip = flip_rest(first, second);
        const RestFlip back = flip_rest(second, first);

        EXPECT_EQ(flip.rest[0].inverse_edges, back.rest[1].inverse_edges);
        EXPECT_EQ(flip.rest[1].inverse_edges, back.rest[0].inverse_edges);
        EXPECT_EQ(flip.rest[0].area, back.rest[1].area);
    }
}

TEST(RestSplit, FlipKeepsTheAreaWhereTheEdgeHasTwoLengths) {
    const RestTriangle first = rest_of({Vec2(0, 1), Vec2(-1, 0), Vec2(1, 0)});
    RestTriangle second = rest_of({Vec2(0, -1), Vec2(1, 0), Vec2(-1, 0)});
    second.inverse_edges *= 1.0 + 5e-7;
    second.area /= (1.0 + 5e-7) * (1.0 + 5e-7);

    const RestFlip flip = flip_rest(first, second);

    EXPECT_NEAR(flip.rest[0].area + flip.rest[1].area, first.area + second.area, 1e-15);
    for (const RestTriangle& rest : flip.rest) {
        EXPECT_NEAR(rest.area * 2.0 * rest.inverse_edges.determinant(), 1.0, 1e-14);
    }
}

TEST(RestSplit, ShareOfAFlipFallsBelowZeroWhereTheQuadrilateralIsNotConvex) {
    const Vec2 P(0, 1), a(-1, 0), b(1, 0);
    const auto fraction = [&](const Vec2& Q) {
        return flip_rest(rest_of({P, a, b}), rest_of({Q, b, a})).least_fraction;
    };

    EXPECT_NEAR(fraction(Vec2(0, -1)), 0.5, 1e-15);
    EXPECT_NEAR(fraction(Vec2(2, -1)), 0.0, 1e-15); // b lies on the line P Q
    EXPECT_LT(fraction(Vec2(3, -1)), -0.1);
}

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
