#include "walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {

using Vec3 = Eigen::Vector3d;

namespace {

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

/// From 0 to 1 between two times, at rest at both.
double rise(double t, double from, double to) {
    const double s = std::clamp((t - from) / (to - from), 0.0, 1.0);
    return s * s * s * (10.0 - s * (15.0 - 6.0 * s));
}

Eigen::Quaterniond about(const Vec3& axis, double angle) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

/// Share of the full walk: it sets out in the first eighth and stops in the last.
double vigour(const WalkParams& params, double t) {
    const double d = params.duration;
    return rise(t, 0.0, 0.15 * d) * (1.0 - rise(t, 0.8 * d, 0.97 * d));
}

double heading(const WalkParams& params, double t) {
    return radians(params.turn_deg) * rise(t, 0.3 * params.duration, 0.75 * params.duration);
}

/// Leg swings carry the figure: both legs sweep their arc in each period.
Vec3 way_at(const WalkParams& params, double leg_length, double t) {
    constexpr int k_steps = 400;
    const double speed = 2.0 * leg_length * std::sin(radians(params.stride_deg)) * params.steps;
    Vec3 way = Vec3::Zero();
    for (int i = 0; i < k_steps; ++i) {
        const double at = t * (i + 0.5) / k_steps;
        const double angle = heading(params, at);
        way += speed * vigour(params, at) * (t / k_steps) *
               Vec3(std::sin(angle), 0.0, std::cos(angle));
    }
    return way;
}

} // namespace

Pose walk_pose(const WalkParams& params, const Skeleton& skeleton, double t) {
    const double share = vigour(params, t);
    const double phase = 2.0 * std::numbers::pi * 0.5 * params.steps * t;
    const double swing = radians(params.stride_deg) * share * std::sin(phase);
    const double raised =
        radians(params.raise_deg) * rise(t, 0.45 * params.duration, 0.75 * params.duration);
    const auto& joints = skeleton.joints;
    const double leg = joints[LeftThigh].place.y() - joints[LeftShin].place.y();
    Pose pose;
    pose.turns.fill(Eigen::Quaterniond::Identity());
    pose.way = way_at(params, 2.0 * leg, t);
    pose.turns[Pelvis] = about(Vec3::UnitY(), heading(params, t));
    pose.turns[Chest] = about(Vec3::UnitY(), 0.15 * swing);
    for (const bool left : {true, false}) {
        const double forward = left ? swing : -swing;
        const double lifted = share * 0.5 * (1.0 + std::cos(phase)) * (left ? 1.0 : 0.0) +
                              share * 0.5 * (1.0 - std::cos(phase)) * (left ? 0.0 : 1.0);
        pose.turns[left ? LeftThigh : RightThigh] = about(Vec3::UnitX(), -forward);
        // The leg that swings forward bends its knee.
        pose.turns[left ? LeftShin : RightShin] =
            about(Vec3::UnitX(), radians(params.stride_deg) * lifted * lifted);
        pose.turns[left ? LeftArm : RightArm] =
            about(Vec3::UnitZ(), left ? raised : -raised) * about(Vec3::UnitX(), 0.5 * forward);
    }
    return pose;
}

} // namespace weft
