#include "adapt/adaptation_plan.h"
#include "support/adaptive_cloths.h"
#include "support/mesh_history.h"
#include "support/sheets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace weft {

namespace {

/// A sheet that stands and moves under maps of its plane, and one criterion to look at it with.
struct Looked {
    Cloth cloth;
    std::vector<Vec3> x, v;
    std::vector<double> near, indicator;

    using Map = std::function<Vec3(const Vec2&)>;
    Looked(const Sheet& sheet, const AdaptParams& adapt, const Map& place, const Map& velocity)
        : cloth(test::cloth_of(sheet)), x(test::placed(sheet, place)),
          v(test::placed(sheet, velocity)) {
        cloth.params.adapt = adapt;
        look();
    }
    void look() { find_refinement_indicator(cloth, x, v, near, indicator); }
};

constexpr AdaptParams k_curvature{.levels = 4, .curvature = 0.1, .compression = 0.0};
constexpr AdaptParams k_compression{.levels = 4, .curvature = 0.0, .compression = 0.02};
constexpr AdaptParams k_velocity{
    .levels = 4, .curvature = 0.0, .compression = 0.0, .velocity = 0.5};

Vec3 at_rest(const Vec2&) {
    return Vec3::Zero();
}
Vec3 flat(const Vec2& u) {
    return {u.x(), 0.0, -u.y()};
}

int boundary_sides(const Cloth& cloth, std::size_t t) {
    const auto& sides = cloth.topology.triangle_edges[t];
    return static_cast<int>(std::count_if(sides.begin(), sides.end(), [&](Index e) {
        return cloth.topology.edges[at(e)].is_boundary();
    }));
}

TEST(RefinementIndicator, OfACylinderIsItsSizeOverTwoRadiiOverTheLimit) {
    const double radius = 0.5;
    const Sheet sheet = equilateral_sheet(20, 20, 0.02);
    const Looked looked(
        sheet, k_curvature,
        [&](const Vec2& u) {
            const double angle = u.x() / radius;
            return Vec3(radius * std::sin(angle), radius * std::cos(angle), u.y());
        },
        at_rest);

    for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
        if (boundary_sides(looked.cloth, t) > 1) {
            continue; // a corner of the sheet: it takes what its neighbour sees in one direction
        }
        const double size = std::sqrt(looked.cloth.rest[t].area);
        const double expected = size / (2.0 * radius) / 0.1;
        EXPECT_NEAR(looked.indicator[t], expected, 0.02 * expected);
    }
}

TEST(RefinementIndicator, IsNothingOnAFlatSheetThatMovesAsARigidBody) {
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
    const Sheet sheet = irregular_sheet(8, 8, 1.0, 1.0, 0.25, 3);
    const Looked looked(
        sheet, {.levels = 4, .curvature = 0.1, .compression = 0.02, .velocity = 0.0},
        [&](const Vec2& u) { return Vec3(turn * flat(u) + Vec3(1.0, 2.0, 3.0)); },
        [](const Vec2&) { return Vec3(5.0, 0.0, 1.0); });

    EXPECT_LT(*std::max_element(looked.indicator.begin(), looked.indicator.end()), 1e-9);
}

TEST(RefinementIndicator, OfCompressionIsWhatTheLesserStretchLacks) {
    const Sheet sheet = irregular_sheet(5, 5, 1.0, 1.0, 0.25, 4);
    for (const double along : {1.2, 1.0, 0.97}) {
        for (const double across : {0.9, 0.99, 1.1}) {
            const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3::UnitX()).toRotationMatrix();
            const Eigen::Rotation2Dd oblique(0.4);
            const Looked looked(
                sheet, k_compression,
                [&](const Vec2& u) {
                    const Vec2 w = oblique * u;
                    return Vec3(turn * Vec3(along * w.x(), across * w.y(), 0.0));
                },
                at_rest);

            const double expected = std::max(0.0, 1.0 - std::min(along, across)) / 0.02;
            for (const double found : looked.indicator) {
                EXPECT_NEAR(found, expected, 1e-9);
            }
        }
    }
}

TEST(RefinementIndicator, OfCompressionCountsFromWhatBucklesWavesOfTwoEdges) {
    const double edge = 0.1;
    const double compression = 0.04;
    const double buckles = 0.05;
    const Sheet sheet = equilateral_sheet(4, 4, edge);
    Looked looked(
        sheet, k_compression,
        [&](const Vec2& u) { return Vec3((1.0 - compression) * u.x(), 0.0, u.y()); }, at_rest);
    FabricParams& fabric = looked.cloth.params.fabric;
    fabric.stretch_stiffness = {800.0, 1200.0};
    // a wave of length L under the force P a width: P = B (2 pi / L)^2
    fabric.bend_stiffness = buckles * 1000.0 / std::pow(std::numbers::pi / edge, 2);
    looked.look();

    for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
        if (std::abs(looked.cloth.rest[t].area - std::sqrt(3.0) / 4.0 * edge * edge) < 1e-12) {
            EXPECT_NEAR(looked.indicator[t], compression / buckles, 1e-9);
        }
    }
    EXPECT_GT(*std::max_element(looked.indicator.begin(), looked.indicator.end()), 0.79);
}

TEST(RefinementIndicator, OfVelocityIsItsGreatestDifferenceAlongAnEdge) {
    const Sheet sheet = union_jack_sheet(4, 4, 1.0, 1.0); // edges of 0.25 m, and diagonals
    const Looked sheared(sheet, k_velocity, flat,
                         [](const Vec2& u) { return Vec3(0.0, 3.0 * u.x(), 0.0); });
    const Looked growing(sheet, k_velocity, flat,
                         [](const Vec2& u) { return Vec3(2.0 * u.x(), 0.0, 2.0 * u.y()); });
    const Looked moving(sheet, k_velocity, flat, [](const Vec2&) { return Vec3(1.0, 9.0, 2.0); });

    for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
        EXPECT_NEAR(sheared.indicator[t], 3.0 * 0.25 / 0.5, 1e-12);
        EXPECT_NEAR(growing.indicator[t], 2.0 * 0.25 * std::sqrt(2.0) / 0.5, 1e-12);
        EXPECT_EQ(moving.indicator[t], 0.0);
    }
}

TEST(RefinementIndicator, IsTheGreatestOfAllCriteria) {
    const Sheet sheet = union_jack_sheet(4, 4, 1.0, 1.0);
    const auto squeezed = [](const Vec2& u) { return Vec3(0.95 * u.x(), 0.0, u.y()); };
    const auto sheared = [](const Vec2& u) { return Vec3(0.0, 3.0 * u.x(), 0.0); };
    AdaptParams all = k_compression;
    all.velocity = k_velocity.velocity;

    const Looked compression(sheet, k_compression, squeezed, sheared);
    const Looked velocity(sheet, k_velocity, squeezed, sheared);
    const Looked both(sheet, all, squeezed, sheared);

    for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
        EXPECT_EQ(both.indicator[t], std::max(compression.indicator[t], velocity.indicator[t]));
    }
}

TEST(RefinementIndicator, CountsTheObstacleNearbyAsItsOwnCurvature) {
    const Sheet sheet = union_jack_sheet(4, 4, 1.0, 1.0);
    Looked looked(sheet, k_curvature, flat, at_rest);
    looked.near.assign(sheet.points.size(), 0.0);
    looked.near[12] = 5.0; // 1/m, at the middle

    looked.look();

    for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
        const Triangle& corners = sheet.triangles[t];
        const bool is_near = std::find(corners.begin(), corners.end(), 12) != corners.end();
        const double size = std::sqrt(looked.cloth.rest[t].area);
        EXPECT_NEAR(looked.indicator[t], is_near ? 5.0 * size / 0.1 : 0.0, 1e-9);
    }
}

} // namespace

namespace {

Cloth refined_sheet(int times) {
    test::MeshHistory history(test::adaptive_sheet(union_jack_sheet(4, 4, 1.0, 1.0)), 1);
    for (int i = 0; i < times; ++i) {
        history.refine_all();
    }
    return history.cloth;
}

std::vector<double> everywhere(const Cloth& cloth, double indicator) {
    return std::vector<double>(cloth.triangles.size(), indicator);
}

TEST(AdaptationPlan, RefinesWhatIsCoarserThanTheToleranceTheCoarsestFirst) {
    Cloth cloth = refined_sheet(0);
    std::vector<double> indicator = everywhere(cloth, 0.5);
    indicator[3] = 1.5;
    indicator[7] = 4.0;
    indicator[9] = 1.0; // just fine enough
    indicator[20] = 1.5;

    EXPECT_EQ(plan_adaptation(cloth, indicator).refine, (std::vector<Index>{7, 3, 20}));
    cloth.refinement.tolerance = 2.0;
    EXPECT_EQ(plan_adaptation(cloth, indicator).refine, (std::vector<Index>{7}));
}

TEST(AdaptationPlan, NothingIsToBeDoneOnAnImportedMeshThatIsFineEnough) {
    const Cloth cloth = refined_sheet(0);

    EXPECT_TRUE(plan_adaptation(cloth, everywhere(cloth, 0.0)).empty());
    EXPECT_TRUE(plan_adaptation(cloth, everywhere(cloth, 1.0)).empty());
}

TEST(AdaptationPlan, TrianglesStayWiderThanTheCloth) {
    Cloth cloth = refined_sheet(0); // of 1/32 m^2: parts are sqrt(1/96) = 0.102 m wide
    const auto thickness = [&](double value) {
        cloth.params.fabric.thickness = value;
        return plan_adaptation(cloth, everywhere(cloth, 2.0)).refine.size();
    };

    EXPECT_EQ(thickness(0.102 / k_least_width * 1.01), 0u);
    EXPECT_EQ(thickness(0.102 / k_least_width * 0.99), cloth.triangles.size());
}

TEST(AdaptationPlan, TakesOutOnlyWhatHasStayedLongEnough) {
    Cloth cloth = refined_sheet(1);
    Refinement& refinement = cloth.refinement;
    const std::size_t inserted = refinement.vertices.size();
    ASSERT_GT(inserted, 1u);
    refinement.adaptations = refinement.vertices[0].born + k_dwell - 1;
    EXPECT_TRUE(plan_adaptation(cloth, everywhere(cloth, 0.0)).remove.empty());
    ++refinement.adaptations;
    EXPECT_EQ(plan_adaptation(cloth, everywhere(cloth, 0.0)).remove.size(), inserted);

    refinement.vertices[1].born = refinement.adaptations;

    const std::vector<Index> remove = plan_adaptation(cloth, everywhere(cloth, 0.0)).remove;
    EXPECT_EQ(remove.size(), inserted - 1);
    EXPECT_EQ(std::count(remove.begin(), remove.end(), refinement.base_vertices + 1), 0);
}

TEST(AdaptationPlan, KeepsAVertexWhileAnyTriangleAtItIsNeeded) {
    Cloth cloth = refined_sheet(1);
    cloth.refinement.adaptations = 100;
    std::vector<double> indicator = everywhere(cloth, 0.99 * k_coarsen_fraction);
    indicator[5] = 1.01 * k_coarsen_fraction;

    const AdaptationPlan plan = plan_adaptation(cloth, indicator);

    EXPECT_TRUE(plan.refine.empty());
    for (Index v = cloth.refinement.base_vertices; v < cloth.vertex_count; ++v) {
        const Triangle& kept = cloth.triangles[5];
        const bool is_kept = std::find(kept.begin(), kept.end(), v) != kept.end();
        EXPECT_EQ(std::count(plan.remove.begin(), plan.remove.end(), v), is_kept ? 0 : 1);
    }
}

TEST(AdaptationPlan, TakesTheFinestOutFirst) {
    Cloth cloth = refined_sheet(3);
    cloth.refinement.adaptations = 100;

    const std::vector<Index> remove = plan_adaptation(cloth, everywhere(cloth, 0.0)).remove;

    ASSERT_EQ(remove.size(), cloth.refinement.vertices.size());
    EXPECT_TRUE(std::is_sorted(remove.begin(), remove.end(), [&](Index a, Index b) {
        return cloth.refinement.inserted(a).generation > cloth.refinement.inserted(b).generation;
    }));
    EXPECT_GT(cloth.refinement.inserted(remove.front()).generation, 1);
}

/// The indicator goes with a triangle's width (compression and velocity less so): what is put
/// in just above the tolerance is 1/sqrt(3) of it after, and what is taken out below the fraction,
/// sqrt(3).
TEST(AdaptationPlan, DoesNotTakeOutWhatItWouldPutInAgain) {
    EXPECT_LT(k_coarsen_fraction * std::sqrt(3.0), 1.0);
    EXPECT_GT(1.0 / std::sqrt(3.0), k_coarsen_fraction);
}

TEST(AdaptationTolerance, RisesWhileTrianglesAreShortAndComesBackToOne) {
    double tolerance = 1.0;
    EXPECT_EQ(next_tolerance(tolerance, false), 1.0);
    for (int i = 0; i < 20; ++i) {
        const double next = next_tolerance(tolerance, true);
        EXPECT_GT(next, tolerance);
        tolerance = next;
    }
    int steps = 0;
    for (; tolerance > 1.0; ++steps) {
        const double next = next_tolerance(tolerance, false);
        EXPECT_LT(next, tolerance);
        tolerance = next;
    }
    EXPECT_EQ(tolerance, 1.0);
    EXPECT_GT(steps, 20); // slower than it rose
}

} // namespace

} // namespace weft
