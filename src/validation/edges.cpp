#include "scene/law_shape.h"
#include "state/build_world.h"
#include "validation/experiment_world.h"
#include "validation/experiments.h"
#include "validation/statics.h"

#include <fmt/core.h>

#include <cmath>

namespace weft {

namespace {

constexpr double k_edge = 0.02; // m
constexpr int k_particles = 32; // in a column of the paper's cloths: 1 kg, 32 x 32 particles
constexpr double k_particle_mass = 1.0 / (k_particles * k_particles);

/// Stretch at which an edge of K = 1 N/m and L = 1 m pulls with `tension`: by halving, as the laws
/// here grow all the way.
double stretch_under(const LawShape& shape, double tension) {
    double low = 1.0;
    double high = 3.0;
    for (int i = 0; i < 200; ++i) {
        const double e = 0.5 * (low + high) - 1.0;
        const double g = e * (1.0 + e * (0.5 * shape.p + e * shape.q / 3.0));
        (g < tension ? low : high) = 1.0 + e;
    }
    return low;
}

struct Chain {
    Model model = Model::Cubic;
    SpringParams spring{.K = 500.0, .K1 = 3000.0, .K2 = 1000.0};
    double load = 0.0; ///< kg at the lower end
};

/// Stretch of each edge from the top, of the weight below it.
std::vector<double> stretches_in_theory(const Chain& chain) {
    const LawShape shape = law_shape(chain.model, chain.spring);
    std::vector<double> stretches;
    for (int below = k_particles - 1; below > 0; --below) {
        const double weight = k_earth_gravity * (below * k_particle_mass + chain.load);
        stretches.push_back(stretch_under(shape, weight / (chain.spring.K * k_edge)));
    }
    return stretches;
}

/// The same of a column of particles brought to rest by the simulation's own forces.
std::vector<double> measured_stretches(const Chain& chain) {
    World world;
    Cloth cloth;
    cloth.name = "column";
    cloth.params.model = chain.model;
    cloth.params.spring = chain.spring;
    cloth.vertex_count = k_particles;
    cloth.material_positions.resize(k_particles, Vec2::Zero());
    for (Index i = 0; i < k_particles; ++i) {
        world.positions.emplace_back(0.0, -k_edge * i, 0.0);
        world.masses.push_back(k_particle_mass);
        if (i > 0) {
            cloth.network.push_back({{i - 1, i}, k_edge, chain.spring.K, EdgeKind::Side});
        }
    }
    world.masses.back() += chain.load;
    world.velocities.resize(k_particles, Vec3::Zero());
    world.previous_positions = world.positions;
    world.previous_velocities = world.velocities;
    world.cloths.push_back(std::move(cloth));

    SceneParams scene = empty_space();
    scene.gravity = Vec3(0.0, -k_earth_gravity, 0.0);
    StaticLoad load(world.vertex_count());
    load.hold(0);
    settle(world, scene, load, {.tolerance = 1e-10});
    std::vector<double> stretches;
    for (std::size_t i = 1; i < world.positions.size(); ++i) {
        stretches.push_back((world.positions[i] - world.positions[i - 1]).norm() / k_edge);
    }
    return stretches;
}

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value;
    }
    return sum / static_cast<double>(values.size());
}

double greatest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        greatest = std::max(greatest, std::abs(a[i] - b[i]));
    }
    return greatest;
}

} // namespace

/// A cube of 5 kg on 32 columns: Vogiannou et al. 2010, figure 5. Theory are the numbers that the
/// three laws give by hand, so this also checks the laws themselves.
ValidationRows validate_loaded_chain() {
    struct Case {
        const char* name;
        Model model;
        double stretch;
    };
    ValidationRows rows;
    for (const Case& c :
         {Case{"full cubic", Model::Cubic, 1.0738}, Case{"linear", Model::Linear, 1.1686},
          Case{"two-term cubic", Model::StvkEdge, 1.1385}}) {
        const Chain chain{.model = c.model, .load = 5.0 / k_particles};
        rows.push_back({.what = fmt::format("mean stretch under five times its weight: {}", c.name),
                        .theory = c.stretch,
                        .measured = mean(measured_stretches(chain)),
                        .tolerance = 0.001,
                        .note = "32 particles; K = 500 N/m; K1 = 6 K; K2 = 2 K; a = 1.1 and 0.9"});
    }
    return rows;
}

/// Deformation of hanging cloth over K, K1 and a1: the same, figure 8.
ValidationRows validate_hanging_chain() {
    double greatest = 0.0;
    int cases = 0;
    for (const double K : {100.0, 200.0, 500.0, 1000.0, 2000.0}) {
        for (const double ratio : {2.0, 4.0, 6.0}) {
            for (const double a1 : {1.02, 1.04, 1.1, 1.2}) {
                const Chain chain{.spring = {.K = K, .K1 = ratio * K, .K2 = 2.0 * K, .a1 = a1}};
                const auto soft = softening(chain.model, chain.spring);
                if (!soft.empty() && soft.back().to > 1.0) {
                    continue; // the weight would snap it through
                }
                greatest = std::max(greatest, greatest_difference(measured_stretches(chain),
                                                                  stretches_in_theory(chain)));
                ++cases;
            }
        }
    }
    return {{.what = "stretch of each edge of hanging chains: greatest error",
             .theory = 0.0,
             .measured = greatest,
             .tolerance = 1e-6,
             .relative = false,
             .note = fmt::format("{} chains of 32 particles: K 100 to 2000 N/m; K1 2 to 6 K; "
                                 "a1 1.02 to 1.2",
                                 cases)}};
}

namespace {

constexpr int k_cells = 8;

/// A unit square of edges calibrated to a fabric. Quads have both diagonals.
World calibrated_world(const Sheet& sheet, const FabricParams& fabric, bool has_quads) {
    ClothParams params;
    params.model = Model::Cubic;
    params.fabric = fabric;
    params.spring.calibrate = true;
    params.spring.bend = 0.0;
    ImportedMesh mesh = imported(sheet);
    for (Index& polygon : mesh.polygons) {
        polygon /= has_quads ? 2 : 1;
    }
    World world;
    add_cloth(world, params, mesh);
    return world;
}

/// Shear modulus of the square whose border is sheared by 1, N/m.
double shear_test(const Sheet& sheet, const Eigen::SparseMatrix<double>& stiffness) {
    StaticLoad load(sheet.points.size());
    load.hold_all(2);
    for (const Index v : vertices_where(sheet, [](const Vec2& p) {
             return std::min({p.x(), p.y(), 1.0 - p.x(), 1.0 - p.y()}) < 1e-9;
         })) {
        load.hold(v, 0, sheet.points[static_cast<std::size_t>(v)].y());
        load.hold(v, 1, 0.0);
    }
    const Eigen::VectorXd u = linear_response(stiffness, load);
    return u.dot(stiffness * u); // twice the energy of a unit of area
}

} // namespace

/// How far edges calibrated to a fabric are from it as a whole: pulled along weft, and sheared.
/// Edges alone make c12 = c33, which fabrics need not have, so tolerances here are what is told of
/// the calibration, not round-off.
ValidationRows validate_calibrated_edges() {
    struct Case {
        const char* name;
        Pattern pattern;
        bool has_quads;
        double tolerance; ///< for a fabric that edges can be; for another 6 % more
    };
    ValidationRows rows;
    for (const Case& c : {Case{"quads", Pattern::UnionJack, true, 0.002},
                          Case{"one diagonal", Pattern::OneDiagonal, false, 0.25},
                          Case{"alternating diagonals", Pattern::UnionJack, false, 0.02},
                          Case{"irregular triangles", Pattern::Irregular, false, 0.2}}) {
        const Sheet sheet = make_sheet(c.pattern, k_cells, k_cells, 1.0, 1.0);
        const auto add = [&](const FabricParams& fabric, const char* kind, double tolerance) {
            const World world = calibrated_world(sheet, fabric, c.has_quads);
            const auto stiffness = stiffness_matrix(world, empty_space());
            rows.push_back({.what = fmt::format("Young's modulus of {}: {}", kind, c.name),
                            .unit = "N/m",
                            .theory = fabric.stretch_stiffness[0],
                            .measured = tensile_test(sheet, stiffness).modulus,
                            .tolerance = tolerance,
                            .note = "8 x 8 cells; calibrated edges"});
            rows.push_back({.what = fmt::format("shear modulus of {}: {}", kind, c.name),
                            .unit = "N/m",
                            .theory = fabric.shear_stiffness,
                            .measured = shear_test(sheet, stiffness),
                            .tolerance = tolerance,
                            .note = "8 x 8 cells; calibrated edges"});
        };
        add(isotropic_membrane(1000.0, 1.0 / 3.0), "a fabric that edges can be", c.tolerance);
        add(FabricParams{}, "the default fabric", c.tolerance + 0.06);
    }
    return rows;
}

} // namespace weft
