#include "geometry/distance.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

namespace {

Vec3 at(const Vec3& w, const std::array<Vec3, 3>& x) {
    return w[0] * x[0] + w[1] * x[1] + w[2] * x[2];
}

/// Nearest of a fine lattice of points on the triangle.
double slow_distance(const Vec3& p, const std::array<Vec3, 3>& x) {
    constexpr int n = 200;
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j) {
            const Vec3 w(1.0 - (i + j) / double{n}, i / double{n}, j / double{n});
            nearest = std::min(nearest, (at(w, x) - p).norm());
        }
    }
    return nearest;
}

} // namespace

TEST(ClosestPoints, EachRegionOfATriangleGivesItsOwnWeights) {
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);

    EXPECT_LT(
        (closest_weights_on_triangle({0.25, 0.25, 3}, a, b, c) - Vec3(0.5, 0.25, 0.25)).norm(),
        1e-15);
    EXPECT_LT((closest_weights_on_triangle({-1, -1, 1}, a, b, c) - Vec3(1, 0, 0)).norm(), 1e-15);
    EXPECT_LT((closest_weights_on_triangle({3, -1, 1}, a, b, c) - Vec3(0, 1, 0)).norm(), 1e-15);
    EXPECT_LT((closest_weights_on_triangle({0.5, -2, 1}, a, b, c) - Vec3(0.5, 0.5, 0)).norm(),
              1e-15);
    EXPECT_LT((closest_weights_on_triangle({1, 1, 1}, a, b, c) - Vec3(0, 0.5, 0.5)).norm(), 1e-15);
}

TEST(ClosestPoints, AreNeverFartherThanASlowSearchFinds) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    const auto point = [&] {
        return Vec3(coordinate(random), coordinate(random), coordinate(random));
    };
    for (int i = 0; i < 200; ++i) {
        const std::array<Vec3, 3> x{point(), point(), point()};
        const Vec3 p = 2.0 * point();

        const Vec3 w = closest_weights_on_triangle(p, x[0], x[1], x[2]);

        const double distance = (at(w, x) - p).norm();
        EXPECT_LE(distance, slow_distance(p, x) + 1e-12);
        EXPECT_GE(w.minCoeff(), 0.0);
        EXPECT_NEAR(w.sum(), 1.0, 1e-14);
    }
}

TEST(ClosestPoints, TriangleWithoutAreaActsAsItsLongestEdge) {
    const Vec3 w = closest_weights_on_triangle({0.5, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0.25, 0, 0});

    EXPECT_NEAR(w[1] + 0.25 * w[2], 0.5, 1e-15);
}

namespace {

/// Least distance of two segments by a grid of both parameters that closes in on the best place.
double sampled_distance(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
    double best = std::numeric_limits<double>::infinity();
    Vec2 centre(0.5, 0.5);
    for (double width = 0.5; width > 1e-9; width *= 0.5) {
        Vec2 next = centre;
        for (int i = -10; i <= 10; ++i) {
            for (int j = -10; j <= 10; ++j) {
                const double s = std::clamp(centre[0] + 0.1 * i * width, 0.0, 1.0);
                const double t = std::clamp(centre[1] + 0.1 * j * width, 0.0, 1.0);
                const double d = (a0 + s * (a1 - a0) - b0 - t * (b1 - b0)).norm();
                if (d < best) {
                    best = d;
                    next = Vec2(s, t);
                }
            }
        }
        centre = next;
    }
    return best;
}

class RandomPoints {
public:
    Vec3 operator()() { return {unit_(engine_), unit_(engine_), unit_(engine_)}; }

private:
    std::mt19937 engine_{11};
    std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

void expect_pair(
    const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1, double s, double t) {
    const Vec2 found = closest_weights_on_segments(a0, a1, b0, b1);
    EXPECT_NEAR(found[0], s, 1e-12);
    EXPECT_NEAR(found[1], t, 1e-12);
}

} // namespace

TEST(ClosestOnSegments, EachRegionByHand) {
    const Vec3 a0(0, 0, 0), a1(1, 0, 0);

    expect_pair(a0, a1, {0.25, 1, -1}, {0.25, 1, 3}, 0.25, 0.25); // inside both
    expect_pair(a0, a1, {2, 0, -1}, {2, 0, 1}, 1.0, 0.5);         // end of the first
    expect_pair(a0, a1, {0.5, 0, 1}, {0.5, 0, 2}, 0.5, 0.0);      // end of the second
    expect_pair(a0, a1, {2, 1, 0}, {3, 1, 0}, 1.0, 0.0);          // end to end
    expect_pair(a0, a1, {-1, 0, 1}, {-2, 0, 1}, 0.0, 0.0);
}

TEST(ClosestOnSegments, ParallelAndPointLikeOnesHaveTheRightDistance) {
    const Vec3 a0(0, 0, 0), a1(1, 0, 0), b0(0.5, 0.1, 0), b1(1.5, 0.1, 0);

    EXPECT_DOUBLE_EQ(separation(PairKind::EdgeEdge, {a0, a1, b0, b1}).distance, 0.1);
    EXPECT_DOUBLE_EQ(separation(PairKind::EdgeEdge, {a0, a1, b1, b0}).distance, 0.1);
    EXPECT_DOUBLE_EQ(separation(PairKind::EdgeEdge, {a0, a0, b0, b0}).distance,
                     std::hypot(0.5, 0.1));
    const double nearly = 1e-9; // closer to parallel than can be solved for
    const Vec3 c0(0, 0.1, 0), c1(1, 0.1 + nearly, nearly);
    EXPECT_NEAR(separation(PairKind::EdgeEdge, {a0, a1, c0, c1}).distance, 0.1, 1e-9);
}

TEST(ClosestOnSegments, AgreesWithSamplingOnRandomOnes) {
    RandomPoints random;

    for (int i = 0; i < 1000; ++i) {
        const Vec3 a0 = random(), a1 = random(), b0 = random(), b1 = random();
        const double distance = separation(PairKind::EdgeEdge, {a0, a1, b0, b1}).distance;
        EXPECT_NEAR(distance, sampled_distance(a0, a1, b0, b1), 1e-6) << i;
    }
}

TEST(Separation, WeightsRebuildTheConnection) {
    RandomPoints random;

    for (int i = 0; i < 1000; ++i) {
        const PairPoints x{random(), random(), random(), random()};
        for (const PairKind kind : {PairKind::VertexFace, PairKind::EdgeEdge}) {
            const Separation place = separation(kind, x);
            Vec3 connection = Vec3::Zero();
            double sum = 0.0;
            for (std::size_t k = 0; k < 4; ++k) {
                connection += place.weights[k] * x[k];
                sum += place.weights[k];
            }
            EXPECT_NEAR(sum, 0.0, 1e-14);
            EXPECT_LT((connection - place.distance * place.normal).norm(), 1e-13);
            EXPECT_GE(place.distance + 1e-12, gap_along(kind, x, place.normal));
        }
    }
}

TEST(Separation, OfAVertexIsNoMoreThanToAnyPointOfTheFace) {
    RandomPoints random;

    for (int i = 0; i < 1000; ++i) {
        const PairPoints x{random(), random(), random(), random()};
        const double distance = separation(PairKind::VertexFace, x).distance;
        double sampled = std::numeric_limits<double>::infinity();
        for (int j = 0; j <= 60; ++j) {
            for (int k = 0; k <= 60 - j; ++k) {
                const Vec3 q = x[1] + j / 60.0 * (x[2] - x[1]) + k / 60.0 * (x[3] - x[1]);
                sampled = std::min(sampled, (x[0] - q).norm());
            }
        }
        EXPECT_LE(distance, sampled + 1e-14);
        EXPECT_GE(distance, sampled - 0.06); // the grid is 1/60 of sides up to 3.5 long
    }
}

namespace {

constexpr ApproachLimit k_limit{.distance = 1e-3, .fraction = 0.5};

PairPoints moved(const PairPoints& x, const PairPoints& motion, double t) {
    PairPoints result;
    for (std::size_t i = 0; i < 4; ++i) {
        result[i] = x[i] + t * motion[i];
    }
    return result;
}

double limit_of(PairKind kind, const PairPoints& x) {
    return std::min(k_limit.distance, k_limit.fraction * separation(kind, x).distance);
}

} // namespace

TEST(TimeOfImpact, VertexFallingOnAFaceIsStoppedJustAboveTheLimit) {
    const PairPoints x{Vec3(0.2, 1, 0.2), Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)};
    const PairPoints motion{Vec3(0, -2, 0), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};

    const auto toi = time_of_impact(PairKind::VertexFace, x, motion, k_limit);

    // It would be at the limit at (1 - 0.001) / 2; the gap left is at most a tenth.
    ASSERT_TRUE(toi);
    EXPECT_LT(*toi, 0.4995);
    EXPECT_GT(*toi, 0.4995 - 0.05);
}

TEST(TimeOfImpact, FaceMovingAtAnObstacleSpeedOf20MetresASecondIsSeen) {
    const PairPoints x{Vec3(0, 0.05, 0), Vec3(-1, 0, -1), Vec3(0, 0, 1), Vec3(1, 0, -1)};
    const Vec3 up(0, 0.1, 0); // 20 m/s for 5 ms
    const PairPoints motion{Vec3::Zero(), up, up, up};

    const auto toi = time_of_impact(PairKind::VertexFace, x, motion, k_limit);

    ASSERT_TRUE(toi);
    EXPECT_NEAR(*toi, 0.49, 0.05);
}

TEST(TimeOfImpact, CrossingEdgesMeetAndPassingOnesDoNot) {
    const PairPoints x{Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, -1), Vec3(0, 1, 1)};
    const PairPoints towards{Vec3::Zero(), Vec3::Zero(), Vec3(0, -4, 0), Vec3(0, -4, 0)};
    const PairPoints beside{Vec3::Zero(), Vec3::Zero(), Vec3(8, -4, 0), Vec3(8, -4, 0)};

    const auto toi = time_of_impact(PairKind::EdgeEdge, x, towards, k_limit);

    ASSERT_TRUE(toi);
    EXPECT_NEAR(*toi, 0.25, 0.03);
    EXPECT_FALSE(time_of_impact(PairKind::EdgeEdge, x, beside, k_limit)); // at y = 0, x = 2
}

TEST(TimeOfImpact, ParallelEdgesMeet) {
    const PairPoints x{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.3, 1, 0), Vec3(1.3, 1, 0)};
    const Vec3 down(0, -2, 0);
    const PairPoints motion{Vec3::Zero(), Vec3::Zero(), down, down};

    const auto toi = time_of_impact(PairKind::EdgeEdge, x, motion, k_limit);

    ASSERT_TRUE(toi);
    EXPECT_NEAR(*toi, 0.47, 0.03);
}

TEST(TimeOfImpact, EdgesInOnePlaneMeetEndOn) {
    const PairPoints x{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0)};
    const PairPoints motion{Vec3::Zero(), Vec3::Zero(), Vec3(-2, 0, 0), Vec3(-2, 0, 0)};

    const auto toi = time_of_impact(PairKind::EdgeEdge, x, motion, k_limit);

    ASSERT_TRUE(toi);
    EXPECT_NEAR(*toi, 0.47, 0.03);
}

TEST(TimeOfImpact, SlidingAtASmallDistanceIsFree) {
    const PairPoints x{Vec3(0.2, 1e-6, 0.2), Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)};
    const PairPoints motion{Vec3(0.5, 0, 0.1), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};

    EXPECT_FALSE(time_of_impact(PairKind::VertexFace, x, motion, k_limit));
}

TEST(TimeOfImpact, GrazingBeyondTheLimitIsFreeAndWithinItIsNot) {
    const auto graze = [](double height) {
        const PairPoints x{Vec3(-2, height, 0), Vec3(0, 0, -1), Vec3(0, 0, 1), Vec3(1, -1, 0)};
        const PairPoints motion{Vec3(4, 0, 0), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
        return time_of_impact(PairKind::VertexFace, x, motion, {.distance = 1e-2});
    };

    EXPECT_FALSE(graze(0.3)); // a pass is met at the limit and a tenth of the gap at the start
    EXPECT_TRUE(graze(0.009));
    EXPECT_TRUE(graze(0.0));
}

TEST(TimeOfImpact, TouchingSidesHaveNoTimeLeftAndPartingOnesMayPart) {
    const PairPoints touching{Vec3(0.2, 0, 0.2), Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)};
    PairPoints near = touching;
    near[0].y() = 1e-9;
    const PairPoints up{Vec3(0, 1, 0), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};

    EXPECT_EQ(time_of_impact(PairKind::VertexFace, touching, up, k_limit), 0.0);
    EXPECT_FALSE(time_of_impact(PairKind::VertexFace, near, up, k_limit));
}

TEST(TimeOfImpact, IsNeverLateAndNeverMissesAgainstFineSampling) {
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto random = [&] { return Vec3(unit(engine), unit(engine), unit(engine)); };
    int met = 0;

    for (int i = 0; i < 2000; ++i) {
        const PairKind kind = i % 2 == 0 ? PairKind::VertexFace : PairKind::EdgeEdge;
        const PairPoints x{random(), random(), random(), random()};
        const PairPoints motion{random(), random(), random(), random()};
        const double limit = limit_of(kind, x);
        const auto toi = time_of_impact(kind, x, motion, k_limit);
        met += toi.has_value();
        const double until = toi.value_or(1.0);
        for (int k = 0; k <= 500; ++k) {
            const double distance = separation(kind, moved(x, motion, until * k / 500.0)).distance;
            ASSERT_GT(distance, limit) << i;
        }
        if (toi) { // and not early: the gap has shrunk to the tenth that it promises
            const double gap = separation(kind, moved(x, motion, *toi)).distance - limit;
            ASSERT_LT(gap, 0.1 * (separation(kind, x).distance - limit) + 1e-12) << i;
        }
    }

    EXPECT_GT(met, 100);
}

} // namespace weft
