#include "validation/experiment_world.h"
#include "validation/experiments.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

namespace weft {

/// What the integrators take out of a vibration, against the closed forms for one mode with
/// z = omega h.
namespace {

using Complex = std::complex<double>;

/// Amplitude factor per substep: |1 / (1 + i z)|, and the greater root of
/// (3/2 + i z) r^2 - 2 r + 1/2 = 0.
double amplitude_factor(Integrator integrator, double z) {
    if (integrator == Integrator::Euler) {
        return 1.0 / std::sqrt(1.0 + z * z);
    }
    const Complex a(1.5, z);
    const Complex root = std::sqrt(4.0 - 2.0 * a);
    return std::max(std::abs((2.0 + root) / (2.0 * a)), std::abs((2.0 - root) / (2.0 * a)));
}

/// The second free-free stretch mode of a strip along x, cos(2 pi x / L) at both the continuum and
/// the lattice: with no lateral contraction the strip is a chain of equal masses and springs.
class StretchMode {
public:
    StretchMode(Integrator integrator, double z) : motion_(scene(integrator)) {
        omega_ = 2.0 * k_cells / k_length * std::sqrt(k_stretch / k_density) *
                 std::sin(std::numbers::pi / k_cells);
        dt_ = z / omega_;
        start_ = motion_.world.positions;
        for (std::size_t i = 0; i < start_.size(); ++i) {
            motion_.world.velocities[i].x() = 1e-3 * omega_ * shape(i);
        }
    }

    /// Amplitude ratio over one substep, after thirty (the other root of BDF2 is gone: 3^-30).
    double measure() {
        motion_.steps(dt_, 30);
        const double before = amplitude();
        motion_.steps(dt_, k_measured);
        return std::pow(amplitude() / before, 1.0 / k_measured);
    }

private:
    static constexpr int k_cells = 16;
    static constexpr int k_measured = 20;
    static constexpr double k_length = 1.0;     // m
    static constexpr double k_stretch = 1000.0; // N/m
    static constexpr double k_density = 0.2;    // kg/m^2, of isotropic_fabric

    static Scene scene(Integrator integrator) {
        Scene scene = vacuum_scene({k_length, k_length / k_cells}, {k_cells, 1},
                                   isotropic_fabric(k_stretch, 0.0, 0.0));
        scene.scene.integrator = integrator;
        return scene;
    }
    double shape(std::size_t i) const {
        return std::cos(2.0 * std::numbers::pi * (start_[i].x() / k_length + 0.5));
    }
    /// |omega q + i p| with q, p the mode's displacement and velocity, up to a constant.
    double amplitude() const {
        const World& world = motion_.world;
        double q = 0.0;
        double p = 0.0;
        for (std::size_t i = 0; i < start_.size(); ++i) {
            const double weight = world.masses[i] * shape(i);
            q += weight * (world.positions[i].x() - start_[i].x());
            p += weight * world.velocities[i].x();
        }
        return std::hypot(omega_ * q, p);
    }

    FreeMotion motion_;
    double omega_, dt_;
    std::vector<Vec3> start_;
};

ValidationRow factor_row(Integrator integrator, double z) {
    return {.what = fmt::format("amplitude factor of a substep at omega h = {}: {}", z,
                                integrator == Integrator::Euler ? "implicit Euler" : "BDF2"),
            .theory = amplitude_factor(integrator, z),
            .measured = StretchMode(integrator, z).measure(),
            .tolerance = 1e-6,
            .note = "stretch mode of a free strip; 16 cells"};
}

/// The greatest rise of the total energy in a substep, as a fraction of the energy at the start,
/// while implicit Euler moves a sheet that was pulled and kicked at random.
ValidationRow energy_row() {
    FreeMotion motion(vacuum_scene({1.0, 1.0}, {8, 8}, isotropic_fabric(2000.0, 0.25, 1e-5)));
    std::mt19937 random(11);
    const auto noise = [&] {
        return static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 0.5;
    };
    for (std::size_t i = 0; i < motion.world.vertex_count(); ++i) {
        motion.world.positions[i] += 5e-3 * Vec3(noise(), noise(), noise());
        motion.world.velocities[i] += 0.5 * Vec3(noise(), noise(), noise());
    }
    const double start = free_energy(motion.world);
    double before = start;
    double greatest_rise = 0.0;
    for (int i = 0; i < 40; ++i) {
        motion.step(0.005);
        const double after = free_energy(motion.world);
        greatest_rise = std::max(greatest_rise, (after - before) / start);
        before = after;
    }
    return {.what = "greatest rise of energy in a substep: implicit Euler",
            .measured = greatest_rise,
            .tolerance = 1e-9,
            .relative = false,
            .note = "share of the start; shaken free sheet; 40 substeps; Newton converged"};
}

} // namespace

ValidationRows validate_energy_decay() {
    ValidationRows rows;
    for (const Integrator integrator : {Integrator::Euler, Integrator::Bdf2}) {
        for (const double z : {0.1, 0.5, 1.0}) {
            rows.push_back(factor_row(integrator, z));
        }
    }
    rows.push_back(energy_row());
    return rows;
}

/// A sheet that falls from rest. With constant acceleration g both integrators can be summed by
/// hand after n substeps of length h, t = n h:
///
///     velocity            g t, both
///     implicit Euler      fall g h^2 n (n + 1) / 2       = g t^2 / 2 + g h t / 2
///     BDF2                fall g t^2 / 2 + 3/4 g h^2 (1 - 3^-n)
///
/// BDF2 is exact but for its first substep, which is one of implicit Euler: it adds g h^2 / 2, and
/// the recursion e+ = (4 e - e-) / 3 of such an offset ends at 3/2 of it.
namespace {

constexpr double k_dt = 0.01;
constexpr int k_substeps = 100;
constexpr double k_round_off = 1e-12;

struct Fall {
    double distance; ///< fall of vertex 0, m
    double speed;    ///< speed of vertex 0, m/s
    double relative; ///< greatest change of position relative to vertex 0, m
};

Fall fall(Integrator integrator) {
    Scene scene = vacuum_scene({1.0, 1.0}, {6, 6}, isotropic_fabric(2000.0, 0.25, 1e-5));
    scene.scene.gravity = Vec3(0.0, -k_earth_gravity, 0.0);
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
             .theory = k_earth_gravity,
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
    const double euler = k_earth_gravity * k_dt * k_dt * n * (n + 1) / 2.0;
    const double bdf2 = 0.5 * k_earth_gravity * std::pow(n * k_dt, 2) +
                        0.75 * k_earth_gravity * k_dt * k_dt * (1.0 - std::pow(3.0, -n));
    ValidationRows rows = rows_of("implicit Euler", fall(Integrator::Euler), euler);
    const ValidationRows second = rows_of("BDF2", fall(Integrator::Bdf2), bdf2);
    rows.insert(rows.end(), second.begin(), second.end());
    rows[3].note = "3/4 g h^2 of it from the first substep; which is implicit Euler";
    return rows;
}

} // namespace weft
