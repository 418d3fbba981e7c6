#include "geometry/shapes.h"
#include "validation/contact_scene.h"
#include "validation/experiment_world.h"
#include "validation/experiments.h"

#include <fmt/core.h>

#include <cmath>
#include <limits>

/// A strip clamped upright above a rough plane that its lower edge stands on. Its clamp is lowered
/// slowly; the strip bows, and its foot slips once the elastica asks for more friction than there
/// is. Experiment: Sano, Yamaguchi and Wada 2017; the elastica was integrated by shooting.
namespace weft {

namespace {

constexpr double k_length = 0.2;       // m
constexpr double k_width = 0.02;       // m
constexpr double k_thickness = 0.5e-3; // m
constexpr double k_bow = 0.17;         // depth of the shape below over the length
constexpr double k_start = 0.5 * k_bow * k_bow * 12.0 / 35.0; // shortening that this bow means
constexpr double k_end = 0.35;
constexpr int k_frames = 100;        // 4 s: slow against the strip's period of 0.1 s
constexpr double k_reference = 0.05; // shortening from which slip counts: the start has settled
constexpr double k_slip = 0.001;     // distance that counts as slip, over the length

/// Sideways place and its slope of a strip that starts bowed, u from clamp to foot: the shape of a
/// beam clamped there and hinged here.
double bow(double u) {
    return k_bow * u * u * (1.0 - u) * (3.0 - 2.0 * u);
}
double bow_slope(double u) {
    return k_bow * u * (6.0 + u * (8.0 * u - 15.0));
}

/// Height below the clamp, in lengths, of the point at u: the strip keeps its length.
double below(double u) {
    constexpr int k_parts = 64;
    double sum = 0.0;
    for (int i = 0; i < k_parts && u > 0.0; ++i) {
        const double slope = bow_slope(u * (i + 0.5) / k_parts);
        sum += std::sqrt(1.0 - slope * slope) * u / k_parts;
    }
    return u > 0.0 ? sum : u;
}

ClothParams strip_cloth(double friction) {
    ClothParams params;
    params.fabric = isotropic_membrane(2000.0, 0.0);
    params.fabric.area_density = 0.05;
    params.fabric.bend_stiffness = 1e-3;
    params.fabric.thickness = k_thickness;
    params.fabric.friction = friction;
    params.fabric.damping = {10.0, 0.0}; // takes 1 % of the load of 0.5 N/m
    return params;
}

/// Shortening, as a fraction of the length, at which the foot begins to slip.
double slip_onset(double friction, const Repeat& repeat) {
    const int cells = 5 * repeat.mesh.cells;
    const ClampedStrip strip(repeat.mesh.pattern, cells,
                             square_cells_across(cells, k_length, k_width), k_length, k_width);
    World world;
    const double top = k_thickness + below(1.0) * k_length;
    const Cloth& cloth =
        add_sheet(world, "strip", strip.sheet, strip_cloth(friction), [&](const Vec2& p) {
            const double u = (p.x() + strip.cell / 2.0) / k_length;
            return Vec3(p.x() > 1e-9 ? k_length * bow(u) : 0.0, top - k_length * below(u), p.y());
        });
    add_body(world, "plane", plane_mesh(Vec3(1.0, 0.0, 1.0)), friction);
    const double lowered = (k_end - k_start) * k_length;
    hold(world, cloth, strip.clamp(), {{0.0, 0.0, 0.0, 0.0}, {4.0, 0.0, -lowered, 0.0}});

    SceneParams space = contact_space(repeat.substeps);
    space.gravity.setZero();
    Stepper stepper({world, space, {}});
    const auto foot = static_cast<std::size_t>(strip.free_end().front());
    double stood = std::numeric_limits<double>::quiet_NaN();
    for (int frame = 1; frame <= k_frames; ++frame) {
        stepper.advance_frame(world, {});
        const double shortened = k_start + (k_end - k_start) * frame / k_frames;
        const double x = world.positions[foot].x();
        if (std::isnan(stood) && shortened >= k_reference) {
            stood = x;
        }
        if (std::abs(x - stood) > k_slip * k_length) {
            return shortened;
        }
    }
    return std::numeric_limits<double>::quiet_NaN();
}

} // namespace

ValidationRows validate_stick_slip(bool thorough) {
    ValidationRows rows;
    for (const Repeat& repeat : repeats(thorough)) {
        for (const auto& [friction, onset] : {std::pair{0.2, 0.155}, std::pair{0.3, 0.271}}) {
            rows.push_back(
                {.what = fmt::format("shortening at which the foot slips: mu {}", friction),
                 .theory = onset,
                 .measured = slip_onset(friction, repeat),
                 .tolerance = 0.02,
                 .relative = false,
                 .note = fmt::format("{} substeps; {}; {} cells along", repeat.substeps,
                                     name_of(repeat.mesh.pattern), 5 * repeat.mesh.cells)});
        }
    }
    return rows;
}

} // namespace weft
