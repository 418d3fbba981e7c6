#include "adapt/patch_momentum.h"

#include "state/rigid_motion.h"

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

/// Fraction of a patch's distance from the origin below which its width is rounding: vertices in a
/// point.
constexpr double k_least_width = 1e-12;

/// Least factor by which velocities other than those of a rigid motion are scaled. Smaller: they
/// jump where masses came nearer to the axis of a spin, which takes energy that cannot be taken off
/// it; larger: adaptations give cloth energy.
constexpr double k_least_scale = 0.98;

/// A rigid motion about a centre.
struct PatchMotion {
    Vec3 centre, velocity, spin;

    Vec3 velocity_at(const Vec3& x) const { return velocity + spin.cross(x - centre); }
};

Mat3 inertia_about(const Vec3& centre, std::span<const double> m, std::span<const Vec3> x) {
    Mat3 inertia = Mat3::Zero();
    for (std::size_t i = 0; i < m.size(); ++i) {
        const Vec3 r = x[i] - centre;
        inertia += m[i] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    }
    return inertia;
}

PatchMomentum
momentum_of(std::span<const double> m, std::span<const Vec3> x, std::span<const Vec3> v) {
    PatchMomentum momentum;
    for (std::size_t i = 0; i < m.size(); ++i) {
        momentum.add(m[i], x[i], v[i]);
    }
    return momentum;
}

} // namespace

void PatchMomentum::add(double m, const Vec3& x, const Vec3& v) {
    mass += m;
    linear += m * v;
    angular += m * x.cross(v);
    kinetic += 0.5 * m * v.squaredNorm();
}

PatchMomentum& PatchMomentum::operator+=(const PatchMomentum& other) {
    mass += other.mass;
    linear += other.linear;
    angular += other.angular;
    kinetic += other.kinetic;
    return *this;
}

void restore_momentum(const PatchMomentum& before,
                      std::span<const double> m,
                      std::span<const Vec3> x,
                      std::span<Vec3> v) {
    PatchMomentum now = momentum_of(m, x, v);
    Vec3 centre = Vec3::Zero();
    for (std::size_t i = 0; i < m.size(); ++i) {
        centre += m[i] / now.mass * x[i];
    }
    const Mat3 inertia = inertia_about(centre, m, x);
    const double least_inertia = now.mass * k_least_width * k_least_width * centre.squaredNorm();
    const auto spin_of = [&](const PatchMomentum& momentum) {
        return weft::spin_of(inertia, momentum.angular - centre.cross(momentum.linear),
                             least_inertia);
    };
    const PatchMomentum missing{0.0, before.linear - now.linear, before.angular - now.angular, 0.0};
    const PatchMotion correction{centre, missing.linear / now.mass, spin_of(missing)};
    for (std::size_t i = 0; i < m.size(); ++i) {
        v[i] += correction.velocity_at(x[i]);
    }

    now = momentum_of(m, x, v);
    if (now.kinetic <= before.kinetic) {
        return;
    }
    const PatchMotion rigid{centre, now.linear / now.mass, spin_of(now)};
    double fluctuation = 0.0;
    for (std::size_t i = 0; i < m.size(); ++i) {
        fluctuation += 0.5 * m[i] * (v[i] - rigid.velocity_at(x[i])).squaredNorm();
    }
    if (!(fluctuation > 0.0)) {
        return;
    }
    const double excess = now.kinetic - before.kinetic;
    const double scale =
        std::max(k_least_scale, std::sqrt(std::max(0.0, 1.0 - excess / fluctuation)));
    for (std::size_t i = 0; i < m.size(); ++i) {
        const Vec3 as_rigid = rigid.velocity_at(x[i]);
        v[i] = as_rigid + scale * (v[i] - as_rigid);
    }
}

} // namespace weft
