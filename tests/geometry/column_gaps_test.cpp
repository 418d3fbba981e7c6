#include "geometry/column_gaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace weft {

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
