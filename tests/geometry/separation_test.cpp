#include "geometry/closest_points.h"
#include "geometry/separation.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

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

} // namespace weft
