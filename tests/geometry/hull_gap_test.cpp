#include "geometry/hull_gap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace weft {

namespace {

using Tetrahedron = std::array<Vec3, 4>;
using Corners3 = std::array<Vec3, 3>;

/// Least distance of two convex bodies by Frank and Wolfe's method on their difference: slow,
/// obvious, from above.
double distance_from_above(const Tetrahedron& a, const Corners3& b) {
    Vec3 p = a[0] - b[0];
    for (int i = 0; i < 4000; ++i) {
        Vec3 best = p;
        for (const Vec3& x : a) {
            for (const Vec3& y : b) {
                if (p.dot(x - y) < p.dot(best)) {
                    best = x - y;
                }
            }
        }
        const Vec3 step = best - p;
        if (step.squaredNorm() < 1e-24) {
            break;
        }
        p += std::clamp(-p.dot(step) / step.squaredNorm(), 0.0, 1.0) * step;
    }
    return p.norm();
}

class Bodies {
public:
    Vec3 point() { return {value_(engine_), value_(engine_), value_(engine_)}; }
    Tetrahedron tetrahedron() { return {point(), point(), point(), point()}; }
    Corners3 triangle(const Vec3& shift) {
        return {point() + shift, point() + shift, point() + shift};
    }

private:
    std::mt19937 engine_{7};
    std::uniform_real_distribution<double> value_{-1.0, 1.0};
};

} // namespace

TEST(HullGap, IsNeverMoreThanTheDistanceAndPartsWhatIsApart) {
    Bodies bodies;
    int apart = 0, meeting = 0;
    for (int i = 0; i < 300; ++i) {
        Tetrahedron a = bodies.tetrahedron();
        const Corners3 b = bodies.triangle(0.7 * bodies.point());
        if (i % 3 == 0) {
            a[3] = (a[0] + a[1] + a[2]) / 3.0; // flat
        }
        const double distance = distance_from_above(a, b);
        const double gap = hull_gap(a, b);
        EXPECT_LE(gap, distance + 1e-9);
        if (distance > 0.02) {
            EXPECT_GT(gap, 0.0);
            EXPECT_GT(gap, 0.3 * distance); // corner to corner the axes see less of it
            ++apart;
        } else if (distance < 1e-6) {
            ++meeting;
        }
    }
    EXPECT_GT(apart, 50);
    EXPECT_GT(meeting, 20);
}

TEST(HullGap, IsTheHeightAboveAFace) {
    const Tetrahedron a{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.2, 0.2, -1)};
    const Corners3 b{Vec3(0.1, 0.1, 0.25), Vec3(0.4, 0.1, 0.25), Vec3(0.1, 0.4, 0.25)};

    EXPECT_DOUBLE_EQ(hull_gap(a, b), 0.25);
}

TEST(HullGap, PartsWhatLiesInOnePlane) {
    const Tetrahedron a{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)};
    const Corners3 b{Vec3(1.5, 0, 0), Vec3(2.5, 0, 0), Vec3(1.5, 1, 0)};

    EXPECT_NEAR(hull_gap(a, b), 0.5, 1e-12);
}

TEST(HullGap, IsNegativeWhereTheyMeet) {
    const Tetrahedron a{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    const Corners3 inside{Vec3(0.1, 0.1, 0.1), Vec3(0.2, 0.1, 0.1), Vec3(0.1, 0.2, 0.1)};
    const Corners3 through{Vec3(-5, -5, 0.2), Vec3(5, -5, 0.2), Vec3(0, 8, 0.2)};

    EXPECT_LT(hull_gap(a, inside), 0.0);
    EXPECT_LT(hull_gap(a, through), 0.0);
}

namespace {

using Corners = std::array<Vec3, 3>;

double least_height(const std::vector<ColumnGap>& gaps) {
    double least = std::numeric_limits<double>::infinity();
    for (const ColumnGap& gap : gaps) {
        least = std::min(least, gap.height);
    }
    return least;
}

/// Height of p over the plane of a triangle along y, when p is over the triangle itself.
std::optional<double> height_over(const Vec3& p, const Corners& t) {
    Mat3 m;
    m << t[1].x() - t[0].x(), t[2].x() - t[0].x(), 0.0, //
        t[1].y() - t[0].y(), t[2].y() - t[0].y(), 1.0,  //
        t[1].z() - t[0].z(), t[2].z() - t[0].z(), 0.0;
    const Vec3 w = m.inverse() * (p - t[0]);
    const bool inside = w[0] >= 0.0 && w[1] >= 0.0 && w[0] + w[1] <= 1.0;
    return inside ? std::optional<double>(w[2]) : std::nullopt;
}

} // namespace

TEST(ColumnGaps, OfParallelTrianglesAreAllTheirDistance) {
    const Corners lower{Vec3(0, 0, 0), Vec3(0, 0, 2), Vec3(2, 0, 0)};
    const Corners upper{Vec3(0.1, 0.3, 0.2), Vec3(0.1, 0.3, 2.2), Vec3(2.1, 0.3, 0.2)};
    std::vector<ColumnGap> gaps;

    column_gaps(upper, lower, Vec3::UnitY(), gaps);

    EXPECT_GE(gaps.size(), 3U);
    for (const ColumnGap& gap : gaps) {
        EXPECT_NEAR(gap.height, 0.3, 1e-15);
        EXPECT_NEAR(gap.weights.sum(), 1.0, 1e-15);
    }
}

TEST(ColumnGaps, OfTrianglesBesideOneAnotherAreNone) {
    const Corners lower{Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)};
    const Corners upper{Vec3(2, 1, 0), Vec3(2, 1, 1), Vec3(3, 1, 0)};
    std::vector<ColumnGap> gaps;

    column_gaps(upper, lower, Vec3::UnitY(), gaps);

    EXPECT_TRUE(gaps.empty());
}

TEST(ColumnGaps, HoldTheLeastHeightOfAllPlaces) {
    std::mt19937 engine(9);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto point = [&] { return Vec3(unit(engine), unit(engine), unit(engine)); };
    int compared = 0;

    for (int i = 0; i < 200; ++i) {
        const Corners lower{point(), point(), point()};
        const Corners upper{point(), point(), point()};
        std::vector<ColumnGap> gaps;
        column_gaps(upper, lower, Vec3::UnitY(), gaps);

        double sampled = std::numeric_limits<double>::infinity();
        for (int a = 0; a <= 60; ++a) {
            for (int b = 0; a + b <= 60; ++b) {
                const Vec3 p =
                    upper[0] + a / 60.0 * (upper[1] - upper[0]) + b / 60.0 * (upper[2] - upper[0]);
                sampled = std::min(sampled, height_over(p, lower).value_or(sampled));
            }
        }
        EXPECT_LE(least_height(gaps), sampled + 1e-9) << i;
        if (std::isfinite(sampled)) {
            ++compared;
        }
    }
    EXPECT_GT(compared, 50);
}

} // namespace weft
