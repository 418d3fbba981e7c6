#include "forces/membrane.h"
#include "geometry/shapes.h"
#include "validation/contact_scene.h"
#include "validation/experiment_world.h"
#include "validation/experiments.h"

#include <fmt/core.h>

#include <cmath>
#include <limits>

/// A strip laid half around a cylinder and drawn over it slowly: Euler and Eytelwein's law, the
/// tensions of its two ends differ by exp(mu pi) when all of it slips.
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

namespace {

constexpr double k_radius = 0.1;     // m
constexpr double k_thickness = 1e-3; // m
constexpr double k_tail = 0.1;       // m, straight, on either side
constexpr double k_width = 0.04;     // m
constexpr double k_stiffness = 1e3;  // N/m
constexpr double k_strain = 0.01;    // at the start
constexpr double k_friction = 0.3;
constexpr double k_speed = 5e-3; // m/s, of both ends: inertia does not count
constexpr int k_frames = 40;     // 8 mm: several times what the tensions need to part
constexpr int k_measured = 10;   // the last of them are measured

constexpr double k_bent_radius = k_radius + k_thickness;
constexpr double k_arc = std::numbers::pi * k_bent_radius;
constexpr double k_length = k_arc + 2.0 * k_tail;

/// Where the point at s (m, from the middle) along the strip and z across it lies.
Vec3 around(double s, double z) {
    const double turned = std::min(std::abs(s), k_arc / 2.0);
    const double tail = std::abs(s) - turned;
    const double angle = std::copysign(turned / k_bent_radius, s);
    return {k_bent_radius * std::sin(angle), k_bent_radius * std::cos(angle) - tail, z};
}

Sheet strip_sheet(const SheetMesh& mesh) {
    const int along = 8 * (mesh.cells + 2);
    const double rest_length = k_length / (1.0 + k_strain);
    const int across = static_cast<int>(std::lround(along * k_width / k_length));
    return make_sheet(mesh.pattern, along, across, rest_length, k_width);
}

/// Force along +y of the strip on some of its vertices, N.
double pull_on(const World& world, std::span<const Index> vertices) {
    const Cloth& cloth = world.cloths[0];
    const MembraneElements membrane(cloth);
    std::vector<Vec3> forces(3 * membrane.size());
    membrane.forces(world.positions_of(cloth), world.velocities_of(cloth), forces);
    double sum = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i) {
        if (std::find(vertices.begin(), vertices.end(), membrane.nodes()[i]) != vertices.end()) {
            sum += forces[i].y();
        }
    }
    return sum;
}

double tension_ratio(const Repeat& repeat) {
    ClothParams params;
    params.fabric = isotropic_membrane(k_stiffness, 0.0);
    params.fabric.area_density = 0.2;
    params.fabric.bend_stiffness = 1e-6;
    params.fabric.thickness = k_thickness;
    params.fabric.friction = k_friction;
    const Sheet sheet = strip_sheet(repeat.mesh);
    World world;
    const Cloth& cloth = add_sheet(world, "strip", sheet, params, [](const Vec2& p) {
        return around((1.0 + k_strain) * p.x() - k_length / 2.0, p.y() - k_width / 2.0);
    });
    add_body(world, "cylinder", cylinder_mesh(k_radius, 2.0 * k_width, 256), k_friction);
    const auto end = [&](double x) {
        return vertices_where(sheet, [=](const Vec2& p) { return std::abs(p.x() - x) < 1e-9; });
    };
    const std::vector<Index> slack = end(0.0);
    const std::vector<Index> tight = end(k_length / (1.0 + k_strain));
    constexpr double k_end = k_frames / k_frame_rate;
    hold(world, cloth, slack, {{0.0, 0.0, 0.0, 0.0}, {k_end, 0.0, k_speed * k_end, 0.0}});
    hold(world, cloth, tight, {{0.0, 0.0, 0.0, 0.0}, {k_end, 0.0, -k_speed * k_end, 0.0}});

    SceneParams space = contact_space(repeat.substeps);
    space.gravity.setZero();
    Stepper stepper({world, space, {}});
    double sum = 0.0;
    for (int frame = 1; frame <= k_frames; ++frame) {
        stepper.advance_frame(world, {});
        if (frame > k_frames - k_measured) {
            sum += pull_on(world, tight) / pull_on(world, slack);
        }
    }
    return sum / k_measured;
}

} // namespace

ValidationRows validate_capstan(bool thorough) {
    ValidationRows rows;
    for (const Repeat& repeat : repeats(thorough)) {
        const SheetMesh mesh{repeat.mesh.pattern, 8 * (repeat.mesh.cells + 2)};
        rows.push_back({.what = "tension ratio over half a turn",
                        .theory = std::exp(k_friction * std::numbers::pi),
                        .measured = tension_ratio(repeat),
                        .tolerance = 0.03,
                        .note = fmt::format("{} substeps; {}; {} cells along", repeat.substeps,
                                            name_of(mesh.pattern), mesh.cells)});
    }
    return rows;
}

} // namespace weft
