#include <algorithm>
#include <cmath>

#include "validation/experiments.h"
#include "validation/motion.h"

/// A sheet that falls from rest. With constant acceleration g both integrators can be summed by
/// hand after n substeps of length h, t = n h:
///
///     velocity            g t, both
///     implicit Euler      fall g h^2 n (n + 1) / 2       = g t^2 / 2 + g h t / 2
///     BDF2                fall g t^2 / 2 + 3/4 g h^2 (1 - 3^-n)
///
/// BDF2 is exact but for its first substep, which is one of implicit Euler: it adds g h^2 / 2, and
/// the recursion e+ = (4 e - e-) / 3 of such an offset ends at 3/2 of it.
namespace weft {

namespace {

constexpr double k_g = 9.81;
constexpr double k_dt = 0.01;
constexpr int k_substeps = 100;
constexpr double k_round_off = 1e-12;

struct Fall {
    double distance; ///< of vertex 0, m
    double speed;    ///< of vertex 0, m/s
    double relative; ///< greatest change of position relative to vertex 0, m
};

Fall fall(Integrator integrator) {
    Scene scene = vacuum_scene({1.0, 1.0}, {6, 6}, isotropic_fabric(2000.0, 0.25, 1e-5));
    scene.scene.gravity = Vec3(0.0, -k_g, 0.0);
    scene.scene.integrator = integrator;
    FreeMotion motion(scene);
    const std::vector<Vec3> start = motion.world.positions;
    motion.steps(k_dt, k_substeps);
    const World& world = motion.world;
    Fall result{start[0].y() - world.positions[0].y(), -world.velocities[0].y(), 0.0};
    for (std::size_t i = 0; i < start.size(); ++i) {
        const Vec3 change = (world.positions[i] - world.positions[0]) - (start[i] - start[0]);
        result.relative = std::max(result.relative, change.norm());
    }
    return result;
}

ValidationRows rows_of(const std::string& name, const Fall& fall, double distance) {
    return {{.what = "distance fallen in 1 s: " + name,
             .unit = "m",
             .theory = distance,
             .measured = fall.distance,
             .tolerance = k_round_off,
             .note = "100 substeps; the sum of the integrator"},
            {.what = "speed after 1 s: " + name,
             .unit = "m/s",
             .theory = k_g,
             .measured = fall.speed,
             .tolerance = k_round_off},
            {.what = "relative motion in free fall: " + name,
             .unit = "m",
             .measured = fall.relative,
             .tolerance = k_round_off,
             .relative = false,
             .note = "greatest over the vertices"}};
}

} // namespace

ValidationRows validate_free_fall() {
    constexpr int n = k_substeps;
    const double euler = k_g * k_dt * k_dt * n * (n + 1) / 2.0;
    const double bdf2 =
        0.5 * k_g * std::pow(n * k_dt, 2) + 0.75 * k_g * k_dt * k_dt * (1.0 - std::pow(3.0, -n));
    ValidationRows rows = rows_of("implicit Euler", fall(Integrator::Euler), euler);
    const ValidationRows second = rows_of("BDF2", fall(Integrator::Bdf2), bdf2);
    rows.insert(rows.end(), second.begin(), second.end());
    rows[3].note = "3/4 g h^2 of it from the first substep; which is implicit Euler";
    return rows;
}

} // namespace weft
