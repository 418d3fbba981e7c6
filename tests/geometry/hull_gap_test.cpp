#include "geometry/hull_gap.h"

#include <gtest/gtest.h>

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

} // namespace weft
