#include "adapt/adaptation_plan.h"

#include "base/parallel.h"
#include "geometry/curvature.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace weft {

namespace {

/// The lesser principal stretch.
double least_stretch(const Triangle& t, const RestTriangle& rest, std::span<const Vec3> x) {
    Mat32 edges;
    edges << x[at(t[1])] - x[at(t[0])], x[at(t[2])] - x[at(t[0])];
    const Mat32 f = edges * rest.inverse_edges;
    const double a = f.col(0).squaredNorm();
    const double b = f.col(0).dot(f.col(1));
    const double c = f.col(1).squaredNorm();
    const double half = 0.5 * (a + c);
    return std::sqrt(std::max(0.0, half - std::hypot(0.5 * (a - c), b)));
}

/// Compression at which a triangle of that rest area buckles, as shallow as can be, in the shortest
/// waves that a mesh of its size can show, over two edges: that of a plate, B (2 pi / wave)^2, over
/// the cloth's stiffness in its plane.
double buckling_strain(const FabricParams& fabric, double area) {
    const double edge_squared = 4.0 / std::numbers::sqrt3 * area;
    const double force = fabric.bend_stiffness * std::numbers::pi * std::numbers::pi / edge_squared;
    return force / fabric.stretch_stiffness.mean();
}

double greatest_difference(const Triangle& t, std::span<const Vec3> v) {
    return std::sqrt(std::max({(v[at(t[0])] - v[at(t[1])]).squaredNorm(),
                               (v[at(t[1])] - v[at(t[2])]).squaredNorm(),
                               (v[at(t[2])] - v[at(t[0])]).squaredNorm()}));
}

} // namespace

void find_refinement_indicator(const Cloth& cloth,
                               std::span<const Vec3> x,
                               std::span<const Vec3> v,
                               std::span<const double> near_curvature,
                               std::vector<double>& indicator) {
    const AdaptParams& adapt = cloth.params.adapt;
    std::vector<double> curvature;
    if (adapt.curvature > 0.0) {
        curvature = mean_curvatures(x, cloth.triangles, cloth.topology);
        for (std::size_t i = 0; i < near_curvature.size(); ++i) {
            curvature[i] = std::max(curvature[i], near_curvature[i]);
        }
    }
    indicator.resize(cloth.triangles.size());
    parallel_for(cloth.triangles.size(), [&](std::size_t i) {
        const Triangle& t = cloth.triangles[i];
        double found = 0.0;
        if (adapt.curvature > 0.0) {
            const double greatest =
                std::max({curvature[at(t[0])], curvature[at(t[1])], curvature[at(t[2])]});
            found = greatest * std::sqrt(cloth.rest[i].area) / adapt.curvature;
        }
        if (adapt.compression > 0.0) {
            const double compression = 1.0 - least_stretch(t, cloth.rest[i], x);
            const double bearable = buckling_strain(cloth.params.fabric, cloth.rest[i].area);
            found = std::max(found, compression / std::max(adapt.compression, bearable));
        }
        if (adapt.velocity > 0.0) {
            found = std::max(found, greatest_difference(t, v) / adapt.velocity);
        }
        indicator[i] = found;
    });
}

namespace {

/// Changes of the tolerance in one adaptation. Faster: triangles come and go at the budget.
constexpr double k_raise = 1.1;
constexpr double k_lower = 0.98;

std::vector<Index> triangles_to_refine(const Cloth& cloth, std::span<const double> indicator) {
    const double width = k_least_width * cloth.params.fabric.thickness;
    std::vector<Index> triangles;
    for (std::size_t t = 0; t < indicator.size(); ++t) {
        if (indicator[t] > cloth.refinement.tolerance && cloth.rest[t].area > 3.0 * width * width) {
            triangles.push_back(static_cast<Index>(t));
        }
    }
    std::stable_sort(triangles.begin(), triangles.end(),
                     [&](Index a, Index b) { return indicator[at(a)] > indicator[at(b)]; });
    return triangles;
}

std::vector<Index> vertices_to_remove(const Cloth& cloth, std::span<const double> indicator) {
    const Refinement& refinement = cloth.refinement;
    const std::size_t count = refinement.vertices.size();
    std::vector<double> around(count, 0.0);
    for (std::size_t t = 0; t < indicator.size(); ++t) {
        for (const Index v : cloth.triangles[t]) {
            if (refinement.is_inserted(v)) {
                double& coarsest = around[at(v - refinement.base_vertices)];
                coarsest = std::max(coarsest, indicator[t]);
            }
        }
    }
    std::vector<Index> vertices;
    for (std::size_t i = 0; i < count; ++i) {
        if (around[i] < k_coarsen_fraction * refinement.tolerance &&
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

AdaptationPlan plan_adaptation(const Cloth& cloth, std::span<const double> indicator) {
    return {triangles_to_refine(cloth, indicator), vertices_to_remove(cloth, indicator)};
}

double next_tolerance(double tolerance, bool is_short_of_triangles) {
    return is_short_of_triangles ? k_raise * tolerance : std::max(1.0, k_lower * tolerance);
}

} // namespace weft
