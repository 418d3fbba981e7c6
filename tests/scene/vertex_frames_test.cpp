#include "scene/vertex_frames.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// Two vertices; the first runs along x: at frame k it is at k squared.
void read_frame(std::size_t k, std::vector<Vec3f>& positions) {
    const auto x = static_cast<float>(k * k);
    positions = {Vec3f(x, 0.0F, 0.0F), Vec3f(0.0F, 1.0F, 0.0F)};
}

double place_at(VertexFrames& frames, double t) {
    std::vector<Vec3> positions(2);
    frames.positions_at(t, Mat3::Identity(), positions);
    EXPECT_EQ(positions[1], Vec3(0.0, 1.0, 0.0));
    return positions[0].x();
}

} // namespace

TEST(VertexFrames, AreLinearBetweenAndConstantOutside) {
    VertexFrames frames({1.0, 2.0, 4.0}, read_frame);

    EXPECT_DOUBLE_EQ(frames.duration(), 3.0);
    for (const auto& [t, x] : std::vector<std::pair<double, double>>{
             {-1.0, 0.0}, {0.0, 0.0}, {0.25, 0.25}, {1.0, 1.0}, {2.0, 2.5}, {3.0, 4.0}, {9, 4}}) {
        EXPECT_DOUBLE_EQ(place_at(frames, t), x) << t;
    }
}

TEST(VertexFrames, GiveTheSameBitsHoweverFewStayInMemory) {
    std::vector<double> times;
    for (int k = 0; k < 20; ++k) {
        times.push_back(0.1 * k);
    }
    int reads = 0;
    const auto counted = [&](std::size_t k, std::vector<Vec3f>& positions) {
        ++reads;
        read_frame(k, positions);
    };
    VertexFrames all(times, read_frame);
    VertexFrames few(times, counted, 2 * sizeof(Vec3f) * 2);

    EXPECT_EQ(all.fingerprint(), few.fingerprint());
    reads = 0;
    for (const double t : {0.05, 0.06, 0.15, 1.85, 0.05, 0.95, 0.96}) {
        EXPECT_EQ(place_at(all, t), place_at(few, t)) << t;
    }
    EXPECT_EQ(reads, 9); // two for each pair of frames, one of them twice used
}

TEST(Playback, StartsLateRunsFasterAndHoldsOrLoops) {
    AnimationParams params{.start = 1.0, .speed = 2.0};
    const auto at = [&](double t) { return time_in_animation(params, 3.0, t); };

    EXPECT_EQ(at(0.0), 0.0);
    EXPECT_EQ(at(1.0), 0.0);
    EXPECT_EQ(at(2.0), 2.0);
    EXPECT_EQ(at(9.0), 3.0);
    params.end = AnimationEnd::Loop;
    EXPECT_EQ(at(3.0), 1.0);
    EXPECT_EQ(at(0.0), 0.0);
    EXPECT_EQ(time_in_animation(params, 0.0, 5.0), 0.0);
}

} // namespace weft
