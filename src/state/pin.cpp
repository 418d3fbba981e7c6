#include "state/pin.h"

#include "base/error.h"
#include "base/parallel.h"
#include "geometry/distance.h"
#include "state/rigid_motion.h"
#include "state/world.h"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <numeric>

namespace weft {

namespace {

/// Orthonormal frame of a triangle: along its first edge, across it, normal. Moves with it rigidly.
Mat3 triangle_frame(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
    Mat3 frame;
    frame.col(0) = (x1 - x0).normalized();
    frame.col(2) = triangle_normal(x0, x1, x2);
    frame.col(1) = frame.col(2).cross(frame.col(0));
    return frame;
}

Vec3 weigh(const std::array<Vec3, 3>& corners, const Vec3& weights) {
    return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

} // namespace

Anchor anchor_to(const Obstacle& obstacle, Index obstacle_index, const Vec3& position) {
    Anchor anchor;
    anchor.obstacle = obstacle_index;
    const Pose pose = obstacle_pose(obstacle, 0.0);
    const auto shape = obstacle_shape(obstacle, 0.0);
    const auto corner = [&](Index v) { return pose * (*shape)[static_cast<std::size_t>(v)]; };
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < obstacle.mesh.triangles.size(); ++t) {
        const Triangle& v = obstacle.mesh.triangles[t];
        const std::array<Vec3, 3> x{corner(v[0]), corner(v[1]), corner(v[2])};
        if (triangle_area(x[0], x[1], x[2]) <= 0.0) {
            continue; // real bodies have some; a frame needs an area
        }
        const Vec3 weights = closest_weights_on_triangle(position, x[0], x[1], x[2]);
        const double distance = (weigh(x, weights) - position).squaredNorm();
        if (distance < nearest) {
            nearest = distance;
            anchor.triangle = static_cast<Index>(t);
            anchor.weights = weights;
        }
    }
    const auto x = obstacle_corners(obstacle, anchor.triangle, 0.0);
    anchor.offset =
        triangle_frame(x[0], x[1], x[2]).transpose() * (position - weigh(x, anchor.weights));
    return anchor;
}

Vec3 pin_position(const Pin& pin,
                  const PinGroup& group,
                  std::span<const Obstacle> obstacles,
                  double t) {
    const Vec3 offset = offset_at(group.move, t);
    if (pin.anchor.obstacle == k_no_index) {
        return pin.start + offset;
    }
    const auto x = obstacle_corners(obstacles[static_cast<std::size_t>(pin.anchor.obstacle)],
                                    pin.anchor.triangle, t);
    return weigh(x, pin.anchor.weights) + triangle_frame(x[0], x[1], x[2]) * pin.anchor.offset +
           offset;
}

namespace {

/// A boundary vertex whose rest angle is below this is a corner.
constexpr double k_corner_angle = 130.0 * std::numbers::pi / 180.0;

std::vector<Index> find_corners(const PinnableMesh& cloth) {
    std::vector<double> angle(cloth.positions.size(), 0.0);
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        const auto m = rest_corners(cloth.rest[t]);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 a = m[(k + 1) % 3] - m[k];
            const Vec2 b = m[(k + 2) % 3] - m[k];
            angle[static_cast<std::size_t>(cloth.triangles[t][k])] +=
                std::atan2(std::abs(a.x() * b.y() - a.y() * b.x()), a.dot(b));
        }
    }
    std::vector<Index> corners;
    for (const auto& loop : boundary_loops(cloth.topology)) {
        for (const Index v : loop) {
            if (angle[static_cast<std::size_t>(v)] < k_corner_angle) {
                corners.push_back(v);
            }
        }
    }
    return corners;
}

double mean_height(const std::vector<Index>& loop, std::span<const Vec3> positions) {
    double sum = 0.0;
    for (const Index v : loop) {
        sum += positions[static_cast<std::size_t>(v)].y();
    }
    return sum / static_cast<double>(loop.size());
}

double loop_length(const std::vector<Index>& loop, std::span<const Vec3> positions) {
    double length = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        length += (positions[static_cast<std::size_t>(loop[(i + 1) % loop.size()])] -
                   positions[static_cast<std::size_t>(loop[i])])
                      .norm();
    }
    return length;
}

std::vector<Index>
find_loop(const PinnableMesh& cloth, const PinParams& pin, const std::string& place) {
    auto loops = boundary_loops(cloth.topology);
    if (loops.empty()) {
        fail_input("{}.loop: the cloth is closed, it has no boundary loop", place);
    }
    const auto order_by = [&](const auto& key) {
        std::stable_sort(loops.begin(), loops.end(),
                         [&](const auto& a, const auto& b) { return key(a) > key(b); });
    };
    if (!pin.loop_side.empty()) {
        order_by([&](const auto& loop) { return mean_height(loop, cloth.positions); });
        return pin.loop_side == "top" ? loops.front() : loops.back();
    }
    order_by([&](const auto& loop) { return loop_length(loop, cloth.positions); });
    if (pin.loop >= static_cast<int>(loops.size())) {
        fail_input("{}.loop = {}: must be 0 to {} (longest first)", place, pin.loop,
                   loops.size() - 1);
    }
    return loops[static_cast<std::size_t>(pin.loop)];
}

Index find_obstacle(const World& world, const std::string& name, const std::string& place) {
    for (std::size_t i = 0; i < world.obstacles.size(); ++i) {
        if (world.obstacles[i].name == name) {
            return static_cast<Index>(i);
        }
    }
    fail_input("{}.to = \"{}\": no obstacle or rigid body has this name", place, name);
}

void select_in_box(const PinParams& pin,
                   std::span<const Vec3> positions,
                   std::vector<Index>& selected) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if ((positions[i].array() >= pin.box_min.array()).all() &&
            (positions[i].array() <= pin.box_max.array()).all()) {
            selected.push_back(static_cast<Index>(i));
        }
    }
}

std::string pin_place(const Solid& solid, std::size_t pin_number) {
    return fmt::format("solid '{}': pin[{}]", solid.body.name, pin_number);
}

std::string cloth_pin_place(std::string_view cloth, std::size_t pin_number) {
    return fmt::format("cloth '{}': pin[{}]", cloth, pin_number);
}

/// A pin `to` a rigid body is a joint: each pulls the other.
struct Joint {
    std::string name;                ///< for messages
    std::span<const Index> vertices; ///< World vertices that are degrees of freedom
    Index rigid;                     ///< index into World::rigids
    double stiffness;                ///< the joined object's, N/m
    double until = k_forever;        ///< s
};

/// Joins vertices at their present places to the body, by pairs that are welded from the start. To
/// be called before build_attachments() gives the pairs their states.
void join_to_rigid(World& world, const Joint& joint) {
    assert(world.attached_states.empty());
    const RigidBody& rigid = world.rigids[static_cast<std::size_t>(joint.rigid)];
    const Pose pose = nearest_pose(rigid.rest, particles_of(rigid, world.positions));
    for (const Index v : joint.vertices) {
        const Vec3 arm = pose.rotation.transpose() *
                         (world.positions[static_cast<std::size_t>(v)] - pose.translation);
        const auto weights = embedding_weights(rigid.rest, arm);
        AttachedPair pair{
            .vertices = {v, k_no_index, k_no_index, k_no_index, k_no_index, k_no_index},
            .weights = {1.0, 0.0, 0.0, 0.0, 0.0, 0.0},
            .attachment = static_cast<Index>(world.attachments.size()),
            .limit = std::numeric_limits<double>::infinity()};
        for (std::size_t k = 0; k < 4; ++k) {
            pair.vertices[k + 1] = rigid.body.first_particle + static_cast<Index>(k);
            pair.weights[k + 1] = -weights[k];
        }
        world.attached_pairs.push_back(pair);
    }
    world.attachments.push_back({.name = joint.name,
                                 .kind = AttachKind::Button,
                                 .close = 0.0,
                                 .until = joint.until,
                                 .stiffness = joint.stiffness,
                                 .is_joint = true});
}

/// Adds the pins or joints of one group. `selected` counts from World vertex `first`.
/// @param stiffness  stretch stiffness of the object that they hold, N/m
void add_pins(World& world,
              const std::vector<Index>& selected,
              Index first,
              const PinParams& params,
              double stiffness,
              const std::string& place) {
    for (std::size_t r = 0; r < world.rigids.size(); ++r) {
        if (world.rigids[r].body.name == params.to) {
            std::vector<Index> vertices = selected;
            for (Index& v : vertices) {
                v += first;
            }
            if (!params.move.empty()) {
                fail_input("{}.move: must be left out: '{}' is moved by what it is joined to",
                           place, params.to);
            }
            join_to_rigid(world, {place, vertices, static_cast<Index>(r), stiffness, params.until});
            return;
        }
    }
    const auto group = static_cast<Index>(world.pin_groups.size());
    world.pin_groups.push_back({params.move, params.until});
    const std::size_t first_pin = world.pins.size();
    for (const Index v : selected) {
        const Vec3& x = world.positions[static_cast<std::size_t>(first + v)];
        world.pins.push_back({first + v, x, {}, group});
    }
    if (params.to.empty()) {
        return;
    }
    const Index obstacle = find_obstacle(world, params.to, place);
    parallel_for(
        selected.size(),
        [&](std::size_t i) {
            Pin& pin = world.pins[first_pin + i];
            pin.anchor =
                anchor_to(world.obstacles[static_cast<std::size_t>(obstacle)], obstacle, pin.start);
        },
        1);
}

} // namespace

std::vector<Index>
select_pinned(const PinnableMesh& cloth, const PinParams& pin, std::size_t pin_number) {
    const std::string place = cloth_pin_place(cloth.name, pin_number);
    const auto vertex_count = static_cast<Index>(cloth.positions.size());
    std::vector<Index> selected;
    for (const Index v : pin.vertices) {
        if (v < 0 || v >= vertex_count) {
            fail_input("{}.vertices: {}: must be 0 to {} (vertices after welding)", place, v,
                       vertex_count - 1);
        }
        selected.push_back(v);
    }
    if (pin.has_box) {
        select_in_box(pin, cloth.positions, selected);
    }
    if (pin.corners) {
        const auto corners = find_corners(cloth);
        selected.insert(selected.end(), corners.begin(), corners.end());
    }
    if (pin.loop >= 0 || !pin.loop_side.empty()) {
        const auto loop = find_loop(cloth, pin, place);
        selected.insert(selected.end(), loop.begin(), loop.end());
    }
    std::sort(selected.begin(), selected.end());
    selected.erase(std::unique(selected.begin(), selected.end()), selected.end());
    if (selected.empty()) {
        fail_input("{}: selects no vertex; must select at least one (vertices, box, corners, loop)",
                   place);
    }
    return selected;
}

std::vector<Index> select_pinned(const World& world,
                                 const Solid& solid,
                                 const PinParams& pin,
                                 std::size_t pin_number) {
    const auto particles = std::span(world.positions)
                               .subspan(static_cast<std::size_t>(solid.body.first_particle),
                                        static_cast<std::size_t>(solid.body.particle_count));
    std::vector<Index> selected;
    select_in_box(pin, particles, selected);
    if (selected.empty()) {
        fail_input("{}.box: holds no particle; must hold at least one at t = 0",
                   pin_place(solid, pin_number));
    }
    return selected;
}

void build_pins(World& world) {
    for (const Cloth& cloth : world.cloths) {
        const PinnableMesh mesh{cloth.name, cloth.triangles, cloth.topology, cloth.rest,
                                world.positions_of(cloth)};
        for (std::size_t number = 0; number < cloth.params.pins.size(); ++number) {
            const PinParams& pin = cloth.params.pins[number];
            add_pins(world, select_pinned(mesh, pin, number), cloth.first_vertex, pin,
                     material_stiffness(cloth.params), cloth_pin_place(cloth.name, number));
        }
    }
    for (const Solid& solid : world.solids) {
        for (std::size_t number = 0; number < solid.params.pins.size(); ++number) {
            const PinParams& pin = solid.params.pins[number];
            add_pins(world, select_pinned(world, solid, pin, number), solid.body.first_particle,
                     pin, solid.params.spring.K, pin_place(solid, number));
        }
    }
    const auto by_vertex = [](const Pin& a, const Pin& b) { return a.vertex < b.vertex; };
    const auto same_vertex = [](const Pin& a, const Pin& b) { return a.vertex == b.vertex; };
    std::stable_sort(world.pins.begin(), world.pins.end(), by_vertex);
    world.pins.erase(std::unique(world.pins.begin(), world.pins.end(), same_vertex),
                     world.pins.end());
}

void hold_pins_here(World& world) {
    assert(world.time == 0.0);
    parallel_for(
        world.pins.size(),
        [&](std::size_t i) {
            Pin& pin = world.pins[i];
            const Vec3& x = world.positions[static_cast<std::size_t>(pin.vertex)];
            if (pin.start == x) {
                return;
            }
            pin.start = x;
            if (pin.anchor.obstacle != k_no_index) {
                const auto obstacle = static_cast<std::size_t>(pin.anchor.obstacle);
                pin.anchor = anchor_to(world.obstacles[obstacle], pin.anchor.obstacle, x);
            }
        },
        1);
}

} // namespace weft
