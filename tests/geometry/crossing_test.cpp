#include "geometry/crossing.h"
#include "geometry/distance.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

namespace {

/// Sign of the same determinant in integers, exact for coordinates below 2^19.
int integer_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto whole = [&](const Vec3& x, Eigen::Index k) {
        return static_cast<std::int64_t>(x[k]) - static_cast<std::int64_t>(d[k]);
    };
    const std::int64_t determinant =
        whole(a, 0) * (whole(b, 1) * whole(c, 2) - whole(b, 2) * whole(c, 1)) -
        whole(a, 1) * (whole(b, 0) * whole(c, 2) - whole(b, 2) * whole(c, 0)) +
        whole(a, 2) * (whole(b, 0) * whole(c, 1) - whole(b, 1) * whole(c, 0));
    return (determinant > 0) - (determinant < 0);
}

} // namespace

TEST(Orientation, IsTheSignOfTheDeterminant) {
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);

    EXPECT_EQ(orientation(a, b, c, {0.2, 0.2, -1}), 1);
    EXPECT_EQ(orientation(a, b, c, {0.2, 0.2, 1}), -1);
    EXPECT_EQ(orientation(a, b, c, {5, -3, 0}), 0);
}

TEST(Orientation, IsExactAmongNearlyFlatPoints) {
    // Integers up to 2^18 in a thin layer: the determinant in doubles is often wrong only in sign.
    std::mt19937 engine(3);
    std::uniform_int_distribution<int> wide(-(1 << 18), 1 << 18);
    std::uniform_int_distribution<int> thin(-1, 1);
    int flat = 0;

    for (int i = 0; i < 2000; ++i) {
        const auto point = [&] {
            const int x = wide(engine), y = wide(engine);
            return Vec3(x, y, x / 2 + y / 2 + thin(engine));
        };
        const Vec3 a = point(), b = point(), c = point();
        const Vec3 d = i % 4 == 0 ? Vec3(2 * b - a) : point();
        EXPECT_EQ(orientation(a, b, c, d), integer_orientation(a, b, c, d)) << i;
        flat += integer_orientation(a, b, c, d) == 0;
    }

    EXPECT_GE(flat, 500);
}

TEST(Orientation, SeesTheLastBitOfACoordinate) {
    const Vec3 a(0.1, 0.1, 0.1), b(0.7, 0.7, 0.7), c(0.3, 0.9, 0.3);
    Vec3 d(0.5, 0.2, 0.5); // all in the plane x = z

    EXPECT_EQ(orientation(a, b, c, d), 0);
    d.x() = std::nextafter(0.5, 1.0);
    const int above = orientation(a, b, c, d);
    d.x() = std::nextafter(0.5, 0.0);
    EXPECT_EQ(orientation(a, b, c, d), -above);
    EXPECT_NE(above, 0);
}

TEST(SegmentMeetsTriangle, ThroughBesideAndShortOfIt) {
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);

    EXPECT_TRUE(segment_meets_triangle({0.2, 0.2, -1}, {0.2, 0.2, 1}, a, b, c));
    EXPECT_TRUE(segment_meets_triangle({0.2, 0.2, 1}, {0.2, 0.2, -1}, a, b, c));
    EXPECT_FALSE(segment_meets_triangle({0.8, 0.8, -1}, {0.8, 0.8, 1}, a, b, c));
    EXPECT_FALSE(segment_meets_triangle({0.2, 0.2, 0.1}, {0.2, 0.2, 1}, a, b, c));
    EXPECT_TRUE(segment_meets_triangle({0.2, 0.2, 0}, {0.2, 0.2, 1}, a, b, c));   // touches
    EXPECT_FALSE(segment_meets_triangle({-1, 0.2, 0}, {2, 0.2, 0}, a, b, c));     // in its plane
    EXPECT_FALSE(segment_meets_triangle({0.2, 0.2, -1}, {0.2, 0.2, 1}, a, b, b)); // without area
}

TEST(TrianglesCross, OnlyBeyondWhatTheyShare) {
    const std::vector<Vec3> x{{0, 0, 0},     {1, 0, 0},      {0, 1, 0},       {1, 1, 0.5},
                              {0.3, 0.3, 1}, {0.3, 0.3, -1}, {0.4, 0.2, 0.5}, {2, 2, 3}};
    const Triangle base{0, 1, 2};

    EXPECT_TRUE(triangles_cross(base, {4, 5, 7}, x));
    EXPECT_FALSE(triangles_cross(base, {4, 6, 7}, x));
    EXPECT_FALSE(triangles_cross(base, {1, 3, 2}, x)); // share a side
    EXPECT_FALSE(triangles_cross(base, {0, 6, 4}, x)); // share a vertex
    EXPECT_TRUE(triangles_cross(base, {0, 4, 5}, x));  // share a vertex, cross beyond it
    EXPECT_TRUE(triangles_cross({0, 4, 5}, base, x));
    EXPECT_FALSE(triangles_cross(base, base, x));
}

TEST(TrianglesCross, PlaceLiesInBoth) {
    const std::vector<Vec3> x{{0, 0, 0},     {1, 0, 0},      {0, 1, 0},
                              {0.2, 0.3, 1}, {0.2, 0.3, -1}, {2, 2, 3}};

    const Vec3 place = crossing_place({0, 1, 2}, {3, 4, 5}, x);

    EXPECT_LT(separation(PairKind::VertexFace, {place, x[0], x[1], x[2]}).distance, 1e-12);
    EXPECT_LT(separation(PairKind::VertexFace, {place, x[3], x[4], x[5]}).distance, 1e-12);
}

TEST(CrossingSegment, EndsOnBothTriangles) {
    std::mt19937 engine(21);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int crossing = 0;

    for (int i = 0; i < 500; ++i) {
        std::vector<Vec3> x;
        for (int k = 0; k < 6; ++k) {
            x.emplace_back(unit(engine), unit(engine), unit(engine));
        }
        if (!triangles_cross({0, 1, 2}, {3, 4, 5}, x)) {
            continue;
        }
        ++crossing;
        const auto ends = crossing_segment({0, 1, 2}, {3, 4, 5}, x);
        for (const Vec3& end : ends) {
            const auto to_s = separation(PairKind::VertexFace, {end, x[0], x[1], x[2]});
            const auto to_t = separation(PairKind::VertexFace, {end, x[3], x[4], x[5]});
            EXPECT_LT(std::max(to_s.distance, to_t.distance), 1e-9) << i;
        }
        EXPECT_GT((ends[0] - ends[1]).norm(), 0.0) << i;
    }
    EXPECT_GT(crossing, 30);
}

TEST(CrossingSegment, OfNeighboursBeginsAtTheCornerThatTheyShare) {
    const std::vector<Vec3> x{{0, 0, 0}, {2, 0, -1}, {2, 0, 1}, {1, 1, 0}, {1, -1, 0}};

    const auto ends = crossing_segment({0, 1, 2}, {0, 3, 4}, x);

    EXPECT_NEAR((ends[0] - ends[1]).norm(), 1.0, 1e-12);
    EXPECT_TRUE(ends[0].isZero(1e-12) || ends[1].isZero(1e-12));
}

TEST(SelfCrossings, AFoldThatPassesThroughItselfIsFound) {
    TriangleMesh mesh; // one triangle flat on the ground, one upright through its middle, one apart
    mesh.positions = {{0, 0, 0},     {2, 0, 0}, {0, 0, 2}, {0.5, -1, 0.5}, {0.5, 1, 0.5},
                      {0.7, 1, 0.5}, {5, 0, 0}, {6, 0, 0}, {5, 0, 1}};
    mesh.triangles = {{6, 7, 8}, {0, 1, 2}, {3, 4, 5}};

    EXPECT_EQ(find_self_crossings(mesh), (std::vector<std::array<Index, 2>>{{1, 2}}));
}

TEST(SelfCrossings, NeighboursThatOnlyTouchDoNotCount) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {-1, 0, -1}, {-1, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}};

    EXPECT_TRUE(find_self_crossings(mesh).empty());
}

namespace {

/// Where the line through a and b meets the plane y = 0.
Vec3 foot(const Vec3& a, const Vec3& b) {
    return a + a.y() / (a.y() - b.y()) * (b - a);
}

} // namespace

TEST(ContourGradient, OfAFlapThroughAFloorPointsBackOut) {
    // an edge stands upright in the floor, its triangle reaches along x: the way out is along x
    const std::vector<Vec3> apex{{1.0, 0.0, 0.0}};

    const auto gradient = contour_gradient({0, -1, 0}, {0, 1, 0}, apex, Vec3::UnitY());

    ASSERT_TRUE(gradient);
    EXPECT_TRUE(gradient->isApprox(Vec3::UnitX(), 1e-12)) << gradient->transpose();
}

TEST(ContourGradient, OfTwoTrianglesThatPullEvenlyIsNone) {
    const std::vector<Vec3> apexes{{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}};

    EXPECT_FALSE(contour_gradient({0, -1, 0}, {0, 1, 0}, apexes, Vec3::UnitY()));
}

TEST(ContourGradient, TakesTheEdgesFootTowardsTheContoursOtherEnd) {
    std::mt19937 engine(11);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);

    for (int i = 0; i < 300; ++i) {
        const Vec3 p(unit(engine), -0.2 - std::abs(unit(engine)), unit(engine));
        const Vec3 q(unit(engine), 0.2 + std::abs(unit(engine)), unit(engine));
        const Vec3 apex(unit(engine), 3.0 + unit(engine), unit(engine));
        const Vec3 contour = foot(p, apex) - foot(p, q); // the side (p, apex) pierces as well

        const auto g = contour_gradient(p, q, std::vector<Vec3>{apex}, Vec3::UnitY());

        ASSERT_TRUE(g);
        const double step = 1e-6;
        const Vec3 way = foot(p + step * *g, q + step * *g) - foot(p, q);
        EXPECT_GT(way.dot(contour), 0.0) << i;
    }
}

} // namespace weft
