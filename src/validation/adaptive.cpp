#include "adapt/rest_split.h"
#include "state/build_world.h"
#include "step/advance.h"
#include "validation/experiment_world.h"
#include "validation/experiments.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

/// A strip that hangs, or is clamped, and swings out of its plane: its period on a mesh that is
/// refined and coarsened as it bends, against that on a mesh as fine all over.
namespace weft {

namespace {

constexpr double k_length = 0.5; ///< m
constexpr double k_width = 0.1;  ///< m
constexpr int k_cells = 10;      ///< square cells along the imported mesh
constexpr int k_levels = 2;      ///< makes edges a third as long
constexpr double k_fps = 50.0;   ///< 1/s: one sample a frame
constexpr double k_swing = 0.05; ///< m, at the free end
constexpr int k_frames = 140;    ///< more than two periods of either strip

/// Least angle that refinement of right-angled isosceles triangles makes: atan(1/3).
constexpr double k_degree = std::numbers::pi / 180.0;
const double k_angle_bound = std::atan(1.0 / 3.0) / k_degree;

struct Strip {
    const char* name;
    double gravity;   ///< along the strip, m/s^2
    double clamp;     ///< length of the clamped part, m
    double rigidity;  ///< N m
    double curvature; ///< limit of the refinement criterion
    double omega;     ///< angular frequency of the first mode, 1/s
};

/// omega = j_01 / 2 sqrt(g / L).
Strip hanging() {
    return {"hanging sheet",
            k_earth_gravity,
            0.0,
            1e-7,
            0.002,
            0.5 * 2.4048255577 * std::sqrt(k_earth_gravity / k_length)};
}

/// omega = 1.8751^2 sqrt(D / (rho L^4)). The edges on the clamp's line bend like half a cell of the
/// strip, which is longer by that (see clamped_strip.h).
Strip clamped() {
    constexpr double clamp = k_length / k_cells;
    constexpr double rigidity = 0.02;
    constexpr double fine_cell = k_length / (3 * k_cells);
    const double square = 1.8751040687 / (k_length - clamp + 0.5 * fine_cell);
    return {"cantilever", 0.0, clamp, rigidity, 0.005, square * square * std::sqrt(rigidity / 0.2)};
}

Scene scene_of(const Strip& strip, bool is_adaptive) {
    const int fineness = is_adaptive ? 1 : 3;
    Scene scene = vacuum_scene({k_length, k_width}, {k_cells * fineness, k_cells / 5 * fineness},
                               isotropic_fabric(1000.0, 0.0, strip.rigidity));
    scene.scene.fps = k_fps;
    scene.scene.substeps = 8;
    scene.scene.integrator = Integrator::Bdf2;
    scene.scene.newton = 1;
    scene.scene.solver_tolerance = 1e-8;
    scene.scene.gravity = {strip.gravity, 0.0, 0.0};
    scene.contact.enabled = false;
    ClothParams& cloth = scene.cloths[0];
    cloth.adapt = {
        .levels = is_adaptive ? k_levels : 0, .curvature = strip.curvature, .compression = 0.0};
    PinParams pin;
    pin.has_box = true;
    pin.box_min = {-k_length, -1.0, -k_width};
    pin.box_max = {strip.clamp - 0.5 * k_length + 1e-9, 1.0, k_width};
    cloth.pins.push_back(pin);
    return scene;
}

/// What a strip did over the frames.
struct Swing {
    double period = 0.0;      ///< s
    double least_angle = 0.0; ///< least angle of the rest shape, degrees
    std::size_t most = 0;     ///< triangles
    int refined = 0, coarsened = 0;
};

Swing swing(const Strip& strip, bool is_adaptive) {
    const Scene scene = scene_of(strip, is_adaptive);
    World world = build_world(scene, [](const std::string&) {});
    const auto is_free = [&](const Vec3& x) { return x.x() > 0.5 * k_length - 1e-9; };
    std::vector<std::size_t> end; // imported vertices, which keep their numbers
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        const Vec3& x = world.positions[i];
        const double s = std::max(0.0, x.x() + 0.5 * k_length - strip.clamp);
        const double shape = s / (k_length - strip.clamp);
        world.velocities[i].y() = k_swing * strip.omega * std::pow(shape, 1.5);
        if (is_free(x)) {
            end.push_back(i);
        }
    }
    const Prepared start(world, scene.scene, scene.contact);
    world = start.world();
    Stepper stepper(start);
    Swing result;
    result.least_angle = least_rest_angle(world.cloths[0]) / k_degree;
    std::vector<double> heights;
    for (int frame = 0; frame < k_frames; ++frame) {
        const FrameReport report = *stepper.advance_frame(world, nullptr);
        double height = 0.0;
        for (const std::size_t i : end) {
            height += world.positions[i].y();
        }
        heights.push_back(height);
        result.least_angle =
            std::min(result.least_angle, least_rest_angle(world.cloths[0]) / k_degree);
        result.most = std::max(result.most, world.triangle_count());
        result.refined += report.refined;
        result.coarsened += report.coarsened;
    }
    result.period = mean_period(heights, 1.0 / k_fps);
    return result;
}

} // namespace

ValidationRows validate_adaptive_periods() {
    ValidationRows rows;
    for (const Strip& strip : {hanging(), clamped()}) {
        const Swing uniform = swing(strip, false);
        const Swing adaptive = swing(strip, true);
        const std::string note = fmt::format(
            "{} of {} triangles at most; {} vertices put in and {} taken out; BDF2; h 2.5 ms",
            adaptive.most, uniform.most, adaptive.refined, adaptive.coarsened);
        rows.push_back({.what = fmt::format("period of a {}: adaptive", strip.name),
                        .unit = "s",
                        .theory = uniform.period,
                        .measured = adaptive.period,
                        .tolerance = 0.02,
                        .note = "against the mesh as fine all over; " + note});
        rows.push_back({.what = fmt::format("period of a {}: fine all over", strip.name),
                        .unit = "s",
                        .theory = 2.0 * std::numbers::pi / strip.omega,
                        .measured = uniform.period,
                        .tolerance = 0.02,
                        .note = "theory of small swings"});
        rows.push_back({.what = fmt::format("{}: least angle below atan(1/3)", strip.name),
                        .unit = "degree",
                        .theory = 0.0,
                        .measured = std::max(0.0, k_angle_bound - adaptive.least_angle),
                        .tolerance = 1e-9,
                        .relative = false,
                        .note = fmt::format("over {} frames the least is {:.2f} degrees", k_frames,
                                            adaptive.least_angle)});
    }
    return rows;
}

} // namespace weft
