#include "adapt/adaptation_plan.h"

#include <algorithm>
#include <numeric>

namespace weft {

namespace {

/// Changes of the tolerance in one adaptation. Faster: triangles come and go at the budget.
constexpr double k_raise = 1.1;
constexpr double k_lower = 0.98;

std::vector<Index> triangles_to_refine(const Cloth& cloth, std::span<const double> coarseness) {
    const double width = k_least_width * cloth.params.fabric.thickness;
    std::vector<Index> triangles;
    for (std::size_t t = 0; t < coarseness.size(); ++t) {
        if (coarseness[t] > cloth.refinement.tolerance &&
            cloth.rest[t].area > 3.0 * width * width) {
            triangles.push_back(static_cast<Index>(t));
        }
    }
    std::stable_sort(triangles.begin(), triangles.end(),
                     [&](Index a, Index b) { return coarseness[at(a)] > coarseness[at(b)]; });
    return triangles;
}

std::vector<Index> vertices_to_remove(const Cloth& cloth, std::span<const double> coarseness) {
    const Refinement& refinement = cloth.refinement;
    const std::size_t count = refinement.vertices.size();
    std::vector<double> around(count, 0.0);
    for (std::size_t t = 0; t < coarseness.size(); ++t) {
        for (const Index v : cloth.triangles[t]) {
            if (refinement.is_inserted(v)) {
                double& coarsest = around[at(v - refinement.base_vertices)];
                coarsest = std::max(coarsest, coarseness[t]);
            }
        }
    }
    std::vector<Index> vertices;
    for (std::size_t i = 0; i < count; ++i) {
        if (around[i] < k_coarsen_share * refinement.tolerance &&
            refinement.adaptations - refinement.vertices[i].born >= k_dwell) {
            vertices.push_back(refinement.base_vertices + static_cast<Index>(i));
        }
    }
    std::stable_sort(vertices.begin(), vertices.end(), [&](Index a, Index b) {
        return refinement.inserted(a).generation > refinement.inserted(b).generation;
    });
    return vertices;
}

} // namespace

AdaptationPlan plan_adaptation(const Cloth& cloth, std::span<const double> coarseness) {
    return {triangles_to_refine(cloth, coarseness), vertices_to_remove(cloth, coarseness)};
}

double next_tolerance(double tolerance, bool is_short_of_triangles) {
    return is_short_of_triangles ? k_raise * tolerance : std::max(1.0, k_lower * tolerance);
}

} // namespace weft
