#include "adapt/obstacle_curvature.h"

#include "base/parallel.h"
#include "geometry/curvature.h"
#include "geometry/distance.h"

#include <algorithm>
#include <cmath>

namespace weft {

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
