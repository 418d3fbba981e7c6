#include "remesh/adapt_world.h"
#include "step/constrained_vertices.h"
#include "step/implicit_step.h"
#include "support/worlds.h"
#include "validation/experiment_world.h"

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

namespace weft {

namespace {

constexpr double k_dt = 1.0 / 150.0; // s
constexpr int k_between = 3;         // substeps from one adaptation to the next

/// An adaptive sheet that nothing touches.
class AdaptiveFlight {
public:
    explicit AdaptiveFlight(const Scene& scene)
        : world(test::build_quietly(scene)),
          is_two_step_(scene.scene.integrator == Integrator::Bdf2) {
        make_adaptive(world);
        implicit_.emplace(world, scene.scene);
        adaptation_.emplace(world, scene.scene.gravity);
        ContactParams off;
        off.enabled = false;
        contact_.emplace(world, off);
    }

    /// Moves to the next adaptation and carries it out; `look` is given the world before and, for
    /// each vertex, the one that it was, or k_no_index.
    template <typename Look> void advance(const Look& look) {
        for (int i = 0; i < k_between; ++i) {
            step();
        }
        const World before = world;
        report = adaptation_->adapt(world, world.time, *contact_, changes_);
        if (!report.changed) {
            return;
        }
        implicit_->remesh(world, changes_);
        std::vector<Index> from(world.vertex_count());
        std::iota(from.begin(), from.end(), 0);
        for (const ClothChanges::Vertex& vertex : changes_[0].vertices) {
            from[static_cast<std::size_t>(vertex.slot)] = vertex.from;
        }
        look(before, from);
    }

    World world;
    AdaptationReport report; ///< of the last adaptation

private:
    void step() {
        find_constrained(world, world.time + k_dt, constrained_);
        ASSERT_TRUE(implicit_->solve(world, constrained_, k_dt, end_positions_, end_velocities_, {})
                        .converged);
        world.previous_positions = world.positions;
        world.previous_velocities = world.velocities;
        world.history_dt = is_two_step_ ? k_dt : 0.0;
        world.positions = end_positions_;
        world.velocities = end_velocities_;
        world.time += k_dt;
    }

    bool is_two_step_;
    std::optional<ImplicitStep> implicit_;
    std::optional<WorldAdaptation> adaptation_;
    std::optional<ContactSolver> contact_;
    ConstrainedVertices constrained_;
    std::vector<Vec3> end_positions_, end_velocities_;
    std::vector<ClothChanges> changes_;
};

Scene sheet_scene(Integrator integrator) {
    Scene scene = test::scene_of(test::record_sheet(8));
    scene.scene.integrator = integrator;
    scene.cloths[0].adapt.levels = 3;
    scene.cloths[0].fabric.bend_stiffness = 1e-4;
    return scene;
}

/// Let fall from level, held by two corners.
Scene hanging(Integrator integrator) {
    Scene scene = sheet_scene(integrator);
    scene.cloths[0].pins.push_back({.vertices = {0, 8}});
    return scene;
}

Scene in_vacuum(Integrator integrator) {
    Scene scene = sheet_scene(integrator);
    scene.scene.gravity.setZero();
    scene.scene.air_density = 0.0;
    return scene;
}

void tumble(World& world) {
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        const Vec3& x = world.positions[i];
        Vec3& v = world.velocities[i];
        v = Vec3(0.3, 0.0, 0.0) + Vec3(2.0, 1.0, 3.0).cross(x);
        v.y() += 0.8 * std::sin(6.0 * x.x()) * std::cos(5.0 * x.z());
    }
}

} // namespace

TEST(WorldAdaptation, ChangesNoVelocityByMoreThanATwentiethOfTheRootMeanSquare) {
    for (const Integrator integrator : {Integrator::Euler, Integrator::Bdf2}) {
        for (const bool is_free : {false, true}) {
            AdaptiveFlight flight(is_free ? in_vacuum(integrator) : hanging(integrator));
            if (is_free) {
                tumble(flight.world);
            }
            int adaptations = 0;
            for (int i = 0; i < 50; ++i) {
                flight.advance([&](const World& before, const std::vector<Index>& from) {
                    double squares = 0.0, greatest = 0.0;
                    for (const Vec3& v : before.velocities) {
                        squares += v.squaredNorm();
                    }
                    const auto count = static_cast<double>(before.vertex_count());
                    for (std::size_t v = 0; v < from.size(); ++v) {
                        const bool is_held = std::any_of(
                            flight.world.pins.begin(), flight.world.pins.end(),
                            [&](const Pin& pin) { return pin.vertex == static_cast<Index>(v); });
                        if (from[v] != k_no_index && !is_held) {
                            const Vec3& old = before.velocities[static_cast<std::size_t>(from[v])];
                            greatest =
                                std::max(greatest, (flight.world.velocities[v] - old).norm());
                        }
                    }
                    EXPECT_LT(greatest, 0.05 * std::sqrt(squares / count));
                    ++adaptations;
                });
            }
            EXPECT_GT(adaptations, 15);
        }
    }
}

double greatest_stretch(const Cloth& cloth, std::span<const Vec3> x) {
    double greatest = 0.0;
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        const auto corner = [&](std::size_t k) {
            return x[static_cast<std::size_t>(cloth.triangles[t][k])];
        };
        Mat32 edges;
        edges << corner(1) - corner(0), corner(2) - corner(0);
        const Mat32 f = edges * cloth.rest[t].inverse_edges;
        greatest = std::max(greatest, f.jacobiSvd().singularValues()[0]);
    }
    return greatest;
}

/// A flip of a fold of 20 degrees shortens what lies across it and stretches nothing by more than
/// the inverse of the cosine of half of it.
TEST(WorldAdaptation, StretchesClothByLittle) {
    AdaptiveFlight flight(in_vacuum(Integrator::Euler));
    tumble(flight.world);
    double rise = 0.0;
    for (int i = 0; i < 80; ++i) {
        flight.advance([&](const World& before, const std::vector<Index>&) {
            rise = std::max(rise, greatest_stretch(flight.world.cloths[0], flight.world.positions) -
                                      greatest_stretch(before.cloths[0], before.positions));
        });
    }
    EXPECT_LT(rise, 1.0 / std::cos(10.0 * std::numbers::pi / 180.0) - 1.0);
}

TEST(WorldAdaptation, CountsWhatEnergyItGave) {
    for (const bool is_free : {false, true}) {
        AdaptiveFlight flight(is_free ? in_vacuum(Integrator::Euler) : hanging(Integrator::Euler));
        if (is_free) {
            tumble(flight.world);
        }
        const Vec3 gravity = is_free ? Vec3(Vec3::Zero()) : SceneParams{}.gravity;
        const auto energy = [&](const World& world) {
            double sum = free_energy(world);
            for (std::size_t v = 0; v < world.vertex_count(); ++v) {
                sum -= world.masses[v] * gravity.dot(world.positions[v]);
            }
            return sum;
        };
        for (int i = 0; i < 40; ++i) {
            flight.advance([&](const World& before, const std::vector<Index>&) {
                EXPECT_NEAR(flight.report.energy, energy(flight.world) - energy(before),
                            1e-9 * (1.0 + std::abs(energy(before))));
            });
        }
    }
}

/// What flips and merges strain is absorbed, and what is left of it taken off the motion. Without
/// that they would give 0.11 of the sheet's energy; most of the rest belongs to its spin, which
/// masses that came nearer to the axis keep up, and is lost when they go back.
TEST(WorldAdaptation, GivesLittleEnergy) {
    for (const Integrator integrator : {Integrator::Euler, Integrator::Bdf2}) {
        AdaptiveFlight flight(in_vacuum(integrator));
        tumble(flight.world);
        const double start = free_energy(flight.world);
        double given = 0.0;
        for (int i = 0; i < 50; ++i) {
            flight.advance([&](const World&, const std::vector<Index>&) {
                given += std::max(0.0, flight.report.energy);
            });
        }
        EXPECT_LT(given, 0.04 * start);
    }
}

TEST(WorldAdaptation, GivesATumblingSheetLittleMotionAndNoEnergyInTheEnd) {
    for (const Integrator integrator : {Integrator::Euler, Integrator::Bdf2}) {
        AdaptiveFlight flight(in_vacuum(integrator));
        tumble(flight.world);
        const double start = free_energy(flight.world);
        double kinetic = 0.0;
        for (int i = 0; i < 50; ++i) {
            flight.advance([&](const World& before, const std::vector<Index>&) {
                kinetic += kinetic_energy(flight.world) - kinetic_energy(before);
            });
        }
        EXPECT_LT(kinetic, 0.03 * start);
        EXPECT_LT(free_energy(flight.world), start);
    }
}

} // namespace weft
