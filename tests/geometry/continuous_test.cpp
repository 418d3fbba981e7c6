#include "geometry/continuous.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

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
