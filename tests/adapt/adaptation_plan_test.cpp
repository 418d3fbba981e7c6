#include "adapt/adaptation_plan.h"
#include "support/adaptive_cloths.h"
#include "support/mesh_history.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace weft {
namespace {

Cloth refined_sheet(int times) {
    test::MeshHistory history(test::adaptive_sheet(union_jack_sheet(4, 4, 1.0, 1.0)), 1);
    for (int i = 0; i < times; ++i) {
        history.refine_all();
    }
    return history.cloth;
}

std::vector<double> everywhere(const Cloth& cloth, double coarseness) {
    return std::vector<double>(cloth.triangles.size(), coarseness);
}

TEST(AdaptationPlan, RefinesWhatIsCoarserThanTheToleranceTheCoarsestFirst) {
    Cloth cloth = refined_sheet(0);
    std::vector<double> coarseness = everywhere(cloth, 0.5);
    coarseness[3] = 1.5;
    coarseness[7] = 4.0;
    coarseness[9] = 1.0; // just fine enough
    coarseness[20] = 1.5;

    EXPECT_EQ(plan_adaptation(cloth, coarseness).refine, (std::vector<Index>{7, 3, 20}));
    cloth.refinement.tolerance = 2.0;
    EXPECT_EQ(plan_adaptation(cloth, coarseness).refine, (std::vector<Index>{7}));
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
    std::vector<double> coarseness = everywhere(cloth, 0.99 * k_coarsen_share);
    coarseness[5] = 1.01 * k_coarsen_share;

    const AdaptationPlan plan = plan_adaptation(cloth, coarseness);

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

/// Coarseness goes with a triangle's width (compression and velocity less so): what is put in just
/// above the tolerance is 1/sqrt(3) of it after, and what is taken out below the share sqrt(3).
TEST(AdaptationPlan, DoesNotTakeOutWhatItWouldPutInAgain) {
    EXPECT_LT(k_coarsen_share * std::sqrt(3.0), 1.0);
    EXPECT_GT(1.0 / std::sqrt(3.0), k_coarsen_share);
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
