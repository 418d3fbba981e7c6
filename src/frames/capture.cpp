#include "frames/capture.h"

#include "frames/cache.h"
#include "frames/measures.h"
#include "geometry/curvature.h"
#include "geometry/extent.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace weft {

namespace {

/// Mean of a triangle value over the triangles around each vertex, weighted by rest area.
template <typename Value>
std::vector<float> average_to_vertices(const Cloth& cloth, const Value& value) {
    const auto count = static_cast<std::size_t>(cloth.vertex_count);
    std::vector<double> sums(count, 0.0);
    std::vector<double> areas(count, 0.0);
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        const double area = cloth.rest[t].area;
        for (const Index v : cloth.triangles[t]) {
            sums[static_cast<std::size_t>(v)] += area * value(t);
            areas[static_cast<std::size_t>(v)] += area;
        }
    }
    std::vector<float> means(count, 0.0F);
    for (std::size_t i = 0; i < count; ++i) {
        means[i] = areas[i] > 0.0 ? static_cast<float>(sums[i] / areas[i]) : 0.0F;
    }
    return means;
}

/// The entry of a quantity by its name, so that the order of k_quantities is free to change.
std::vector<float>& values_of(FrameObject& object, std::string_view quantity) {
    const int index = find_quantity(quantity);
    assert(index >= 0);
    return object.values[static_cast<std::size_t>(index)];
}

void measure_cloth(const World& world, const Cloth& cloth, FrameObject& object) {
    const std::vector<StrainMeasures> m = measure_triangles(world, cloth);
    const auto average = [&](const auto& value) { return average_to_vertices(cloth, value); };
    values_of(object, "stretch") = average([&](std::size_t t) { return m[t].stretch_max; });
    values_of(object, "strain_weft") =
        average([&](std::size_t t) { return 100.0 * m[t].strain_weft; });
    values_of(object, "strain_warp") =
        average([&](std::size_t t) { return 100.0 * m[t].strain_warp; });
    values_of(object, "shear") = average([&](std::size_t t) { return m[t].shear_deg; });
    values_of(object, "stress") = average([&](std::size_t t) { return m[t].tension; });
    for (const double curvature :
         mean_curvatures(world.positions_of(cloth), cloth.triangles, cloth.topology)) {
        values_of(object, "curvature").push_back(static_cast<float>(curvature));
    }
    values_of(object, "level") =
        average([&](std::size_t t) { return triangle_level(cloth, static_cast<Index>(t)); });
    for (float& level : values_of(object, "level")) {
        level = std::round(64.0F * level) / 64.0F; // a mean of equal levels is that level
    }
    for (const Vec3& velocity : world.velocities_of(cloth)) {
        values_of(object, "speed").push_back(static_cast<float>(velocity.norm()));
    }
}

/// Replaces stretch and stress by those of the edges where the model of the cloth is made of edges.
void measure_cloth_edges(const World& world, const Cloth& cloth, FrameObject& object) {
    if (!has_edge_law(cloth.params.model)) {
        return;
    }
    VertexEdgeMeasures measures =
        measure_edges(cloth.network, law_shape(cloth.params.model, cloth.params.spring),
                      world.positions_of(cloth), static_cast<std::size_t>(cloth.vertex_count));
    values_of(object, "stretch") = std::move(measures.stretch);
    values_of(object, "stress") = std::move(measures.tension);
}

std::vector<Vec3f> to_single(std::span<const Vec3> positions) {
    std::vector<Vec3f> single;
    for (const Vec3& position : positions) {
        single.emplace_back(position.cast<float>());
    }
    return single;
}

FrameObject capture_cloth(const World& world, const Cloth& cloth) {
    FrameObject object{.name = cloth.name,
                       .kind = ObjectKind::Cloth,
                       .fabric = cloth.params.fabric.name,
                       .triangles = cloth.triangles};
    object.positions = to_single(world.positions_of(cloth));
    for (const Vec2& material : cloth.material_positions) {
        object.material_positions.emplace_back(material.cast<float>());
    }
    measure_cloth(world, cloth, object);
    measure_cloth_edges(world, cloth, object);
    return object;
}

FrameObject capture_body(const World& world, const Body& body, ObjectKind kind) {
    const auto x = std::span(world.positions)
                       .subspan(static_cast<std::size_t>(body.first_vertex),
                                static_cast<std::size_t>(body.vertex_count));
    FrameObject object{.name = body.name, .kind = kind, .triangles = body.triangles};
    object.positions = to_single(x);
    return object;
}

FrameObject capture_solid(const World& world, const Solid& solid) {
    FrameObject object = capture_body(world, solid.body, ObjectKind::Solid);
    for (const double stretch : surface_stretches(world, solid)) {
        values_of(object, "stretch").push_back(static_cast<float>(stretch));
    }
    for (Index v = 0; v < solid.body.vertex_count; ++v) {
        const auto i = static_cast<std::size_t>(solid.body.first_vertex + v);
        values_of(object, "speed").push_back(static_cast<float>(world.velocities[i].norm()));
    }
    return object;
}

// More of either: slower starts; fewer: pictures that may have to be drawn again.
constexpr double k_most_times = 64.0;
constexpr std::size_t k_most_reach_vertices = 2000;

/// Far points of all the places that an obstacle takes from t = 0 to `end` (s), in single
/// precision: what a camera needs to know of its motion beforehand. Sampled in time and over the
/// vertices.
std::vector<Vec3f> obstacle_reach(const Obstacle& obstacle, double end, double fps) {
    const double steps = std::clamp(std::round(end * fps), 1.0, k_most_times);
    const std::size_t stride = obstacle.mesh.positions.size() / k_most_reach_vertices + 1;
    std::vector<Vec3> positions(obstacle.mesh.positions.size());
    Extent extent;
    for (double step = 0.0; step <= steps; step += 1.0) {
        obstacle_positions(obstacle, end * step / steps, positions);
        for (std::size_t i = 0; i < positions.size(); i += stride) {
            extent.extend(positions[i]);
        }
    }
    std::vector<Vec3f> reach;
    for (const Vec3& x : extent.points()) {
        reach.emplace_back(x.cast<float>());
    }
    return reach;
}

} // namespace

FrameCapture::FrameCapture(const World& world, double fps, int frames) : fps_(fps) {
    for (const Obstacle& obstacle : world.obstacles) {
        RigidShape rigid{.shape = {.name = obstacle.name,
                                   .kind = ObjectKind::Obstacle,
                                   .triangles = obstacle.mesh.triangles},
                         .origin = obstacle.origin,
                         .motion = obstacle.params.motion};
        if (deforms(obstacle)) {
            rigid.shape.reach = obstacle_reach(obstacle, frame_time(frames, fps), fps);
        } else {
            rigid.shape.positions = to_single(obstacle.mesh.positions);
        }
        obstacles_.push_back(std::move(rigid));
    }
}

Frame FrameCapture::capture(const World& world) const {
    Frame frame{.number = world.frame, .time = frame_time(world.frame, fps_)};
    for (const Cloth& cloth : world.cloths) {
        frame.objects.push_back(capture_cloth(world, cloth));
    }
    for (const Solid& solid : world.solids) {
        frame.objects.push_back(capture_solid(world, solid));
    }
    for (const RigidBody& rigid : world.rigids) {
        frame.objects.push_back(capture_body(world, rigid.body, ObjectKind::Rigid));
    }
    for (std::size_t o = 0; o < obstacles_.size(); ++o) {
        if (deforms(world.obstacles[o])) {
            std::vector<Vec3> positions(world.obstacles[o].mesh.positions.size());
            obstacle_positions(world.obstacles[o], world.time, positions);
            frame.objects.push_back(obstacles_[o].shape);
            frame.objects.back().positions = to_single(positions);
        } else {
            frame.objects.push_back(pose_shape(obstacles_[o], frame.time));
        }
    }
    return frame;
}

} // namespace weft
