#include "adapt/adaptation_plan.h"

#include "base/parallel.h"
#include "geometry/curvature.h"
#include "geometry/distance.h"

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

namespace {

std::vector<Box> boxes_of(std::span<const Triangle> triangles, std::span<const Vec3> x) {
    std::vector<Box> boxes(triangles.size());
    parallel_for(triangles.size(), [&](std::size_t i) {
        const Triangle& t = triangles[i];
        boxes[i] = unite(segment_box(x[at(t[0])], x[at(t[1])], 0.0),
                         segment_box(x[at(t[2])], x[at(t[2])], 0.0));
    });
    return boxes;
}

template <typename Ridges>
std::vector<Box> ridge_boxes(const Ridges& ridges, std::span<const Vec3> x) {
    std::vector<Box> boxes;
    for (const auto& ridge : ridges) {
        boxes.push_back(segment_box(x[at(ridge.ends[0])], x[at(ridge.ends[1])], 0.0));
    }
    return boxes;
}

} // namespace

ObstacleCurvature::ObstacleCurvature(const World& world) {
    for (const Obstacle& obstacle : world.obstacles) {
        Body body;
        body.places = *obstacle_shape(obstacle, 0.0);
        body.curvature = mean_curvatures(body.places, obstacle.mesh.triangles, obstacle.topology);
        body.tree = BoxTree(boxes_of(obstacle.mesh.triangles, body.places));
        find_ridges(obstacle, body);
        bodies_.push_back(std::move(body));
    }
}

void ObstacleCurvature::find_ridges(const Obstacle& obstacle, Body& body) {
    const auto& x = body.places;
    for (const MeshEdge& edge : obstacle.topology.edges) {
        if (edge.is_boundary()) {
            continue;
        }
        const double angle = dihedral_angle(x[at(edge.v[0])], x[at(edge.v[1])], x[at(edge.apex[0])],
                                            x[at(edge.apex[1])]);
        if (angle > k_ridge) {
            body.ridges.push_back({edge.v, angle});
        }
    }
    for (const Ridge& ridge : body.ridges) {
        body.curvature[at(ridge.ends[0])] = body.curvature[at(ridge.ends[1])] = 0.0;
    }
    body.ridge_tree = BoxTree(ridge_boxes(body.ridges, x));
}

void ObstacleCurvature::fit(const Obstacle& obstacle, double time, Body& body) const {
    if (deforms(obstacle) && body.fitted != time) {
        body.places = *obstacle_shape(obstacle, time);
        body.tree.refit(boxes_of(obstacle.mesh.triangles, body.places));
        body.ridge_tree.refit(ridge_boxes(body.ridges, body.places));
        body.fitted = time;
    }
}

/// Curvature of the obstacle at its point nearest to p, both in its own frame; 0 beyond the reach.
double ObstacleCurvature::nearest(const Obstacle& obstacle,
                                  const Body& body,
                                  const Vec3& p,
                                  double reach) {
    double limit = reach * reach;
    double curvature = 0.0;
    body.tree.near(p, limit, [&](Index triangle) {
        const Triangle& t = obstacle.mesh.triangles[at(triangle)];
        const Vec3 weights = closest_weights_on_triangle(
            p, body.places[at(t[0])], body.places[at(t[1])], body.places[at(t[2])]);
        Vec3 place = Vec3::Zero();
        double here = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double w = weights[static_cast<Eigen::Index>(k)];
            place += w * body.places[at(t[k])];
            here += w * body.curvature[at(t[k])];
        }
        const double squared = (p - place).squaredNorm();
        if (squared < limit) {
            limit = squared;
            curvature = here;
        }
    });
    return curvature;
}

/// Greatest angle of the ridges within reach of p, rad; 0: there is none.
double ObstacleCurvature::nearest_ridge(const Body& body, const Vec3& p, double reach) {
    double angle = 0.0;
    body.ridge_tree.query(segment_box(p, p, reach), [&](Index i) {
        const Ridge& ridge = body.ridges[at(i)];
        const Vec3& a = body.places[at(ridge.ends[0])];
        const Vec3 along = body.places[at(ridge.ends[1])] - a;
        const double weight = closest_weight_on_segment(p, a, a + along);
        if ((p - a - weight * along).squaredNorm() < reach * reach) {
            angle = std::max(angle, ridge.angle);
        }
    });
    return angle;
}

void ObstacleCurvature::find(const World& world,
                             const Cloth& cloth,
                             double time,
                             std::vector<double>& curvature) {
    const auto x = world.positions_of(cloth);
    const auto v = world.velocities_of(cloth);
    std::vector<double> reach(x.size(), 0.0);
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        for (const Index corner : cloth.triangles[t]) {
            reach[at(corner)] = std::max(reach[at(corner)], std::sqrt(cloth.rest[t].area));
        }
    }
    curvature.assign(x.size(), 0.0);
    for (std::size_t o = 0; o < bodies_.size(); ++o) {
        const Obstacle& obstacle = world.obstacles[o];
        fit(obstacle, time, bodies_[o]);
        const Pose pose = obstacle_pose(obstacle, time);
        parallel_for(x.size(), [&](std::size_t i) {
            const Vec3 p = pose.rotation.transpose() * (x[i] - pose.translation);
            const double far = reach[i] + k_look_ahead * v[i].norm();
            const double over_ridge = nearest_ridge(bodies_[o], p, far) / (2.0 * reach[i]);
            curvature[i] =
                std::max({curvature[i], over_ridge, nearest(obstacle, bodies_[o], p, far)});
        });
    }
}

} // namespace weft
