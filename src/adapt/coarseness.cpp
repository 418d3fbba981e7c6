#include "adapt/coarseness.h"

#include "base/parallel.h"
#include "geometry/curvature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

void find_coarseness(const Cloth& cloth,
                     std::span<const Vec3> x,
                     std::span<const Vec3> v,
                     std::span<const double> near_curvature,
                     std::vector<double>& coarseness) {
    const AdaptParams& adapt = cloth.params.adapt;
    std::vector<double> curvature;
    if (adapt.curvature > 0.0) {
        curvature = mean_curvatures(x, cloth.triangles, cloth.topology);
        for (std::size_t i = 0; i < near_curvature.size(); ++i) {
            curvature[i] = std::max(curvature[i], near_curvature[i]);
        }
    }
    coarseness.resize(cloth.triangles.size());
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
        coarseness[i] = found;
    });
}

} // namespace weft
