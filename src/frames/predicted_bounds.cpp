#include "frames/predicted_bounds.h"

#include "base/error.h"
#include "forces/air.h"
#include "geometry/mesh_measure.h"
#include "geometry/triangle_mesh.h"
#include "state/pin.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace weft {

namespace {

constexpr double k_lengthening = 1.02; // hanging cloth is this much longer than its rest shape
constexpr double k_zigzag = 1.08;      // paths along edges are up to this much too long
constexpr double k_braking = 1.5;      // by air on the upswing, fitted to a sheet of 0.15 kg/m^2
constexpr int k_arc = 6;               // places looked at on that arc
constexpr double k_lean = 0.25;        // drag of cloth that streams in wind, over a plate's
constexpr double k_flutter = 0.2;      // aside in wind and half down, over the distance to the pin
constexpr std::size_t k_most_cloth_rays = 1000; // looks down from a cloth
constexpr std::size_t k_few_pins = 8;           // between which cloth hangs as from a line

/// Mass per area of a cloth, kg/m^2: of its fabric, or of an edge model the mass of the whole
/// object over its area in the first frame.
double area_density(const ClothParams& cloth, const FrameObject& first) {
    if (cloth.model == Model::Corotational) {
        return cloth.fabric.area_density;
    }
    double area = 0.0;
    for (const Triangle& t : first.triangles) {
        const auto at = [&](std::size_t k) {
            return Vec3(first.positions[static_cast<std::size_t>(t[k])].cast<double>());
        };
        area += triangle_area(at(0), at(1), at(2));
    }
    return cloth.spring.mass / area;
}

/// Gravity, wind and air as one cloth feels them until the end of the run.
struct Environment {
    double begin = 0.0, end = 0.0; ///< s
    Vec3 down = -Vec3::UnitY();    ///< direction of gravity, unit
    double gravity = 0.0;          ///< m/s^2; 0: nothing falls
    Vec3 pull = -Vec3::UnitY(); ///< direction of gravity and wind together on hanging cloth, unit
    Vec3 aside = Vec3::Zero();  ///< direction across gravity and wind, unit; zero without wind
    double fastest = k_far;     ///< terminal speed of flat cloth in air, m/s
    double braking = 0.0;       ///< deceleration of swinging cloth by air, 1/m

    double drop_distance(double seconds) const;
};

/// How far a cloth falls from rest against quadratic drag, m.
double Environment::drop_distance(double seconds) const {
    if (gravity <= 0.0 || seconds <= 0.0) {
        return 0.0;
    }
    const double x = gravity * seconds / fastest;
    return x < 1e-6
               ? 0.5 * gravity * seconds * seconds // ln cosh x -> x - ln 2
               : fastest * fastest / gravity * (x + std::log1p(std::exp(-2.0 * x)) - std::log(2.0));
}

Environment environment_of(const Scene& scene,
                           const ClothParams& cloth,
                           const FrameObject& object,
                           double begin) {
    Environment out{.begin = begin, .end = (scene.scene.frames - 1) / scene.scene.fps};
    out.gravity = scene.scene.gravity.norm();
    if (out.gravity > 0.0) {
        out.down = scene.scene.gravity / out.gravity;
    }
    const double density = area_density(cloth, object);
    const double drag = 0.5 * scene.scene.air_density * k_plate_drag;
    if (drag > 0.0) {
        out.fastest = std::sqrt(density * out.gravity / drag);
        out.braking = k_braking * drag / density;
    }
    const Vec3 wind = scene.scene.wind;
    const Vec3 pull = density * scene.scene.gravity + k_lean * drag * wind.norm() * wind;
    out.pull = pull.norm() > 0.0 ? pull.normalized() : out.down;
    if (drag > 0.0 && wind.cross(out.down).norm() > 0.0) {
        out.aside = wind.cross(out.down).normalized();
    }
    return out;
}

/// How a pin moves what it holds from `begin` to time t (s).
Pose pin_motion_between(const PinParams& pin, const Scene& scene, double begin, double t) {
    const double held_until = std::min(t, pin.until);
    Pose motion;
    for (const ObstacleParams& obstacle : scene.obstacles) {
        if (obstacle.name == pin.to) {
            motion = motion_between(obstacle, begin, held_until);
        }
    }
    motion.translation += offset_at(pin.move, held_until) - offset_at(pin.move, begin);
    return motion;
}

/// The triangles as they lie in the frame, in place of their rest shape.
std::vector<RestTriangle> shape_in_frame(std::span<const Triangle> triangles,
                                         std::span<const Vec3> positions) {
    std::vector<RestTriangle> shape;
    for (const Triangle& t : triangles) {
        const Vec3& x0 = positions[static_cast<std::size_t>(t[0])];
        const Vec3 a = positions[static_cast<std::size_t>(t[1])] - x0;
        const Vec3 b = positions[static_cast<std::size_t>(t[2])] - x0;
        const Vec3 axis = a.normalized();
        Mat2 edges;
        edges << a.norm(), b.dot(axis), 0.0, (b - b.dot(axis) * axis).norm();
        shape.push_back({edges.inverse(), 0.5 * edges.determinant()});
    }
    return shape;
}

/// The `[[cloth.pin]]` that holds each vertex of a captured cloth, -1 for free ones; as build_pins
/// chooses them, but by the shape in the frame, so that a box selects rightly at t = 0 alone.
std::vector<int> pin_of_vertices(const FrameObject& object,
                                 const ClothParams& params,
                                 std::span<const Vec3> positions) {
    std::vector<int> holder(positions.size(), -1);
    if (params.pins.empty()) {
        return holder;
    }
    const EdgeTopology topology = build_edges(object.triangles);
    const std::vector<RestTriangle> shape = shape_in_frame(object.triangles, positions);
    const PinnableMesh mesh{object.name, object.triangles, topology, shape, positions};
    for (std::size_t pin = 0; pin < params.pins.size(); ++pin) {
        try {
            for (const Index v : select_pinned(mesh, params.pins[pin], pin)) {
                int& by = holder[static_cast<std::size_t>(v)];
                by = by < 0 ? static_cast<int>(pin) : by;
            }
        } catch (const Error&) {
            // The run's own start has checked its pins. In a later frame, where the mesh has moved
            // or was adapted, a pin may select nothing; the camera then takes its cloth as free.
        }
    }
    return holder;
}

/// One cloth of the first frame and the bounds of where its vertices may go.
class ClothBounds {
public:
    ClothBounds(const Frame& first, std::size_t number, const Scene& scene);

    Extent extent() const;

private:
    struct Hanging {
        Vec3 anchor;
        double length; ///< m
    };
    void find_landing(const Frame& first);
    Hanging hanging(std::size_t v) const;
    void add_swing(std::size_t v, Extent& extent) const;
    void add_fall(std::size_t v, const Vec3& from, double seconds, Extent& extent) const;
    Extent bounds_of_group(int group) const;
    Box3 moved_with(const FrameObject& obstacle, const Extent& extent) const;

    const Scene& scene_;
    const ClothParams& params_;
    const std::vector<FrameObject>& objects_;
    const FrameObject& object_;
    Environment environment_;
    std::vector<Vec3> positions_;
    std::vector<int> holder_;     ///< #V, see pin_of_vertices()
    std::vector<Vec3> pins_;      ///< positions of the held vertices
    MeshDistances to_pin_;        ///< along the mesh, m
    std::vector<double> deepest_; ///< #V, depth along down that obstacles let it fall to, m
};

ClothBounds::ClothBounds(const Frame& first, std::size_t number, const Scene& scene)
    : scene_(scene), params_(scene.cloths[number]), objects_(first.objects),
      object_(first.objects[number]),
      environment_(environment_of(scene, params_, object_, first.time)) {
    for (const Vec3f& x : object_.positions) {
        positions_.emplace_back(x.cast<double>());
    }
    holder_ = pin_of_vertices(object_, params_, positions_);
    std::vector<double> start;
    for (std::size_t v = 0; v < holder_.size(); ++v) {
        start.push_back(holder_[v] >= 0 ? 0.0 : k_far);
        if (holder_[v] >= 0) {
            pins_.push_back(positions_[v]);
        }
    }
    to_pin_ = mesh_distances(positions_, object_.triangles, start);
    find_landing(first);
}

/// A vertex comes no deeper than any other that lands, plus the cloth between them.
void ClothBounds::find_landing(const Frame& first) {
    const std::size_t stride = positions_.size() / k_most_cloth_rays + 1;
    std::vector<Vec3> from;
    for (std::size_t v = 0; v < positions_.size(); v += stride) {
        from.push_back(positions_[v]);
    }
    std::vector<double> start(positions_.size(), k_far);
    if (environment_.gravity > 0.0 && scene_.contact.enabled) {
        const std::vector<double> falls = drop_distances(from, environment_.down, first.objects);
        for (std::size_t i = 0; i < falls.size(); ++i) {
            start[i * stride] = environment_.down.dot(from[i]) + falls[i];
        }
    }
    deepest_ = mesh_distances(positions_, object_.triangles, start).cost;
}

/// The point that a vertex hangs from and how far below: its nearest pin, or the nearest point
/// between few pins, from where the same cloth reaches less far.
ClothBounds::Hanging ClothBounds::hanging(std::size_t v) const {
    const Vec3& x = positions_[v];
    const Vec3& pin = positions_[static_cast<std::size_t>(to_pin_.source[v])];
    const double length = std::max((x - pin).norm(), to_pin_.cost[v] / k_zigzag) * k_lengthening;
    Hanging best{pin, length};
    if (pins_.size() > k_few_pins) {
        return best;
    }
    double nearest = (x - pin).norm();
    for (const Vec3& other : pins_) {
        const Vec3 line = other - pin;
        const double weight =
            std::clamp((x - pin).dot(line) / std::max(line.squaredNorm(), 1e-18), 0.0, 1.0);
        const Vec3 place = pin + weight * line;
        if ((x - place).norm() < nearest) {
            nearest = (x - place).norm();
            best = {place,
                    std::max(nearest, std::sqrt(std::max(0.0, length * length -
                                                                  (place - pin).squaredNorm())))};
        }
    }
    return best;
}

/// Adds the arc on which a vertex swings, from where it is, past where it hangs.
void ClothBounds::add_swing(std::size_t v, Extent& extent) const {
    const auto [pin, length] = hanging(v);
    const Vec3 offset = positions_[v] - pin;
    const double along = offset.dot(environment_.pull);
    const Vec3 across = offset - along * environment_.pull;
    const double angle = std::atan2(across.norm(), along);
    const Vec3 side =
        across.norm() > 1e-9 * length ? across.normalized().eval() : Vec3::Zero().eval();
    const double overswing = 1.0 / (1.0 + environment_.braking * length);
    const double reach = environment_.drop_distance(environment_.end - environment_.begin);
    for (int i = 0; i <= k_arc; ++i) {
        const double fraction = 1.0 - (1.0 + overswing) * i / k_arc; // 1: here, 0: hanging
        const double radius = length + std::abs(fraction) * (offset.norm() - length);
        const double at = fraction * angle;
        Vec3 x = pin + radius * (std::cos(at) * environment_.pull + std::sin(at) * side);
        const double beyond = environment_.down.dot(x) - deepest_[v];
        x -= std::max(0.0, beyond) * environment_.down;
        const Vec3 displacement = x - positions_[v];
        if (displacement.norm() > reach) {
            x = positions_[v] + displacement * (reach / displacement.norm());
        }
        extent.extend(x);
        const double flutter =
            environment_.aside.isZero() ? 0.0 : k_flutter * std::min(length, reach);
        for (const double sign : {-1.0, 1.0}) {
            if (flutter > 0.0) {
                extent.extend(x + sign * flutter * environment_.aside);
                extent.extend(x + sign * flutter * environment_.aside +
                              0.5 * flutter * environment_.down);
            }
        }
    }
}

/// Adds where a vertex falls from a place in so many seconds, drifting with its speed and the wind.
void ClothBounds::add_fall(std::size_t v, const Vec3& from, double seconds, Extent& extent) const {
    const double drop = std::max(0.0, deepest_[v] - environment_.down.dot(from));
    const double fall = std::min(environment_.drop_distance(seconds), drop);
    const double in_air = seconds * (fall < drop ? 1.0 : 0.0);
    extent.extend(from + fall * environment_.down);
    extent.extend(from + fall * environment_.down +
                  in_air *
                      (params_.velocity +
                       (scene_.scene.air_density > 0.0 ? scene_.scene.wind : Vec3::Zero().eval())));
}

/// The bounds of the cloth that the pins of one group (-1: none) hold, moved with them.
Extent ClothBounds::bounds_of_group(int group) const {
    Extent start;
    Extent released;
    const double until = group < 0 ? environment_.begin
                                   : std::max(environment_.begin,
                                              params_.pins[static_cast<std::size_t>(group)].until);
    for (std::size_t v = 0; v < positions_.size(); ++v) {
        const Index source = to_pin_.source[v];
        if ((source == k_no_index ? -1 : holder_[static_cast<std::size_t>(source)]) != group) {
            continue;
        }
        start.extend(positions_[v]);
        Vec3 last = positions_[v];
        if (group >= 0) {
            add_swing(v, start);
            const auto [pin, length] = hanging(v);
            last = pin + length * environment_.pull;
        }
        if (until < environment_.end) {
            add_fall(v, last, environment_.end - until, released);
        }
    }
    Extent extent = start;
    extent.extend(released);
    if (group >= 0) {
        const PinParams& pin = params_.pins[static_cast<std::size_t>(group)];
        for (const double t : times_of_motion(scene_, environment_.begin)) {
            const Pose motion = pin_motion_between(pin, scene_, environment_.begin, t);
            for (const Vec3& x : start.points()) {
                extent.extend(motion * x);
            }
        }
        const Pose motion = pin_motion_between(pin, scene_, environment_.begin, environment_.end);
        for (const Vec3& x : released.points()) {
            extent.extend(motion * x);
        }
    }
    return extent;
}

Extent ClothBounds::extent() const {
    Extent extent;
    for (int group = -1; group < static_cast<int>(params_.pins.size()); ++group) {
        extent.extend(bounds_of_group(group));
    }
    for (const FrameObject& object : objects_) {
        if (!object.reach.empty()) {
            extent.extend(moved_with(object, extent));
        }
    }
    return extent;
}

/// The bounds of cloth that lies on a deforming obstacle or is pinned to it: they extend as far
/// beyond the obstacle's reach as the cloth now extends beyond the obstacle.
Box3 ClothBounds::moved_with(const FrameObject& obstacle, const Extent& extent) const {
    const bool is_pinned = std::any_of(params_.pins.begin(), params_.pins.end(),
                                       [&](const PinParams& p) { return p.to == obstacle.name; });
    const Box3 now = object_extent(obstacle).box();
    if (!is_pinned && !now.contains(object_extent(object_).box().center())) {
        return {};
    }
    const Box3 later = reach_extent(obstacle).box();
    const Box3 cloth = extent.box();
    return {cloth.min() + (later.min() - now.min()).cwiseMin(0.0),
            cloth.max() + (later.max() - now.max()).cwiseMax(0.0)};
}

} // namespace

Extent predict_bounds(const Frame& first, const Scene& scene, const std::vector<bool>& counts) {
    const std::size_t solids = scene.cloths.size();
    const std::size_t rigids = solids + scene.solids.size();
    const std::size_t obstacles = rigids + scene.rigids.size();
    assert(counts.size() == first.objects.size());
    assert(first.objects.size() == obstacles + scene.obstacles.size());
    Extent extent;
    for (std::size_t i = 0; i < first.objects.size(); ++i) {
        if (!counts[i]) {
            continue;
        }
        if (i < solids) {
            extent.extend(ClothBounds(first, i, scene).extent());
        } else if (i < rigids) {
            const SolidParams& solid = scene.solids[i - solids];
            extent.extend(body_bounds(first, i, {solid.velocity, solid.pins}, scene));
        } else if (i < obstacles) {
            extent.extend(body_bounds(first, i, {scene.rigids[i - rigids].velocity, {}}, scene));
        } else {
            extent.extend(obstacle_bounds(first.objects[i], scene.obstacles[i - obstacles], scene,
                                          first.time));
        }
    }
    return extent;
}

} // namespace weft
