#include "frames/motion_bounds.h"

#include "forces/air.h"
#include "frames/area_density.h"
#include "frames/body_outlook.h"
#include "frames/held_vertices.h"
#include "frames/landing.h"
#include "frames/rigid_shape.h"
#include "geometry/mesh_distance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace weft {

namespace {

constexpr double k_far = std::numeric_limits<double>::infinity();
constexpr double k_give = 1.02;   // hanging cloth is this much longer than its rest shape
constexpr double k_zigzag = 1.08; // ways along edges are up to this much too long
constexpr double k_braking = 1.5; // of air on the upswing, fitted to a sheet of 0.15 kg/m^2
constexpr int k_arc = 6;          // places looked at on that way
constexpr double k_lean = 0.25;   // drag of cloth that streams in wind, share of a plate's
constexpr double k_flutter = 0.2; // aside in wind and half down, share of the distance to the pin
constexpr std::size_t k_most_times = 400; // places of an obstacle on its way
constexpr std::size_t k_most_rays = 1000; // looks down from a cloth
constexpr std::size_t k_few_pins = 8;     // between which cloth hangs as from a line

/// The rest of a run as one cloth sees it.
struct Outlook {
    double begin = 0.0, end = 0.0; ///< s
    Vec3 down = -Vec3::UnitY();    ///< of gravity, unit
    double gravity = 0.0;          ///< m/s^2; 0: nothing falls
    Vec3 pull = -Vec3::UnitY();    ///< of gravity and wind together on hanging cloth, unit
    Vec3 aside = Vec3::Zero();     ///< across gravity and wind, unit; zero without wind
    double fastest = k_far;        ///< flat cloth falls in air, m/s
    double braking = 0.0;          ///< of air on swinging cloth, 1/m
    double distance(double seconds) const;
};

/// Fallen from rest against quadratic drag.
double Outlook::distance(double seconds) const {
    if (gravity <= 0.0 || seconds <= 0.0) {
        return 0.0;
    }
    const double x = gravity * seconds / fastest;
    return x < 1e-6
               ? 0.5 * gravity * seconds * seconds // ln cosh x -> x - ln 2
               : fastest * fastest / gravity * (x + std::log1p(std::exp(-2.0 * x)) - std::log(2.0));
}

Outlook
look_out(const Scene& scene, const ClothParams& cloth, const FrameObject& object, double begin) {
    Outlook out{.begin = begin, .end = (scene.scene.frames - 1) / scene.scene.fps};
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

std::vector<double> times_of_motion(const Scene& scene, double begin) {
    const double end = (scene.scene.frames - 1) / scene.scene.fps;
    const double frames = std::max(0.0, std::round((end - begin) * scene.scene.fps));
    const auto steps = std::min(k_most_times, static_cast<std::size_t>(frames));
    std::vector<double> times{begin};
    for (std::size_t i = 1; i <= steps; ++i) {
        times.push_back(begin +
                        (end - begin) * static_cast<double>(i) / static_cast<double>(steps));
    }
    return times;
}

/// The way of an obstacle from `begin` to t, as a motion of the world.
Pose carried(const ObstacleParams& obstacle, double begin, double t) {
    Pose from = pose_at(obstacle.motion, begin);
    Pose to = pose_at(obstacle.motion, t);
    from.translation += obstacle.placement.translate;
    to.translation += obstacle.placement.translate;
    Pose way;
    way.rotation = to.rotation * from.rotation.transpose();
    way.translation = to.translation - way.rotation * from.translation;
    return way;
}

/// The way of what a pin holds.
Pose carried(const PinParams& pin, const Scene& scene, double begin, double t) {
    const double held_until = std::min(t, pin.until);
    Pose way;
    for (const ObstacleParams& obstacle : scene.obstacles) {
        if (obstacle.name == pin.to) {
            way = carried(obstacle, begin, held_until);
        }
    }
    way.translation += offset_at(pin.move, held_until) - offset_at(pin.move, begin);
    return way;
}

Extent reach_extent(const FrameObject& object) {
    Extent extent;
    for (const Vec3f& x : object.reach) {
        extent.extend(x.cast<double>());
    }
    return extent;
}

/// One cloth of the first frame, and how far each of its vertices may come.
class ClothOutlook {
public:
    ClothOutlook(const Frame& first, std::size_t number, const Scene& scene);

    /// Where its vertices may get to.
    Extent extent() const;

private:
    struct Hanger {
        Vec3 place;
        double far; ///< m
    };
    void look_down(const Frame& first);
    Hanger hanger(std::size_t v) const;
    void add_hanging(std::size_t v, Extent& extent) const;
    void add_falling(std::size_t v, const Vec3& from, double seconds, Extent& extent) const;
    Extent of_group(int group) const;
    Box3 taken_along(const FrameObject& obstacle, const Extent& extent) const;

    const Scene& scene_;
    const ClothParams& params_;
    const std::vector<FrameObject>& objects_;
    const FrameObject& object_;
    Outlook outlook_;
    std::vector<Vec3> positions_;
    std::vector<int> holder_;
    std::vector<Vec3> pins_;      ///< places of what is held
    MeshDistances to_pin_;        ///< along the mesh, m
    std::vector<double> deepest_; ///< along down, m, that obstacles let each vertex come to
};

ClothOutlook::ClothOutlook(const Frame& first, std::size_t number, const Scene& scene)
    : scene_(scene), params_(scene.cloths[number]), objects_(first.objects),
      object_(first.objects[number]), outlook_(look_out(scene, params_, object_, first.time)),
      holder_(held_vertices(object_, params_)) {
    for (const Vec3f& x : object_.positions) {
        positions_.emplace_back(x.cast<double>());
    }
    std::vector<double> start;
    for (std::size_t v = 0; v < holder_.size(); ++v) {
        start.push_back(holder_[v] >= 0 ? 0.0 : k_far);
        if (holder_[v] >= 0) {
            pins_.push_back(positions_[v]);
        }
    }
    to_pin_ = mesh_distances(positions_, object_.triangles, start);
    look_down(first);
}

/// A vertex comes no deeper than any other that lands, plus the cloth between them.
void ClothOutlook::look_down(const Frame& first) {
    const std::size_t stride = positions_.size() / k_most_rays + 1;
    std::vector<Vec3> from;
    for (std::size_t v = 0; v < positions_.size(); v += stride) {
        from.push_back(positions_[v]);
    }
    std::vector<double> start(positions_.size(), k_far);
    if (outlook_.gravity > 0.0 && scene_.contact.enabled) {
        const std::vector<double> falls = fall_to_obstacles(from, outlook_.down, first.objects);
        for (std::size_t i = 0; i < falls.size(); ++i) {
            start[i * stride] = outlook_.down.dot(from[i]) + falls[i];
        }
    }
    deepest_ = mesh_distances(positions_, object_.triangles, start).cost;
}

/// Where a vertex hangs from and how far below: its nearest pin, or the nearest place between few
/// pins, from where the same cloth reaches less far.
ClothOutlook::Hanger ClothOutlook::hanger(std::size_t v) const {
    const Vec3& x = positions_[v];
    const Vec3& pin = positions_[static_cast<std::size_t>(to_pin_.source[v])];
    const double far = std::max((x - pin).norm(), to_pin_.cost[v] / k_zigzag) * k_give;
    Hanger best{pin, far};
    if (pins_.size() > k_few_pins) {
        return best;
    }
    double nearest = (x - pin).norm();
    for (const Vec3& other : pins_) {
        const Vec3 line = other - pin;
        const double share =
            std::clamp((x - pin).dot(line) / std::max(line.squaredNorm(), 1e-18), 0.0, 1.0);
        const Vec3 place = pin + share * line;
        if ((x - place).norm() < nearest) {
            nearest = (x - place).norm();
            best = {place,
                    std::max(nearest,
                             std::sqrt(std::max(0.0, far * far - (place - pin).squaredNorm())))};
        }
    }
    return best;
}

/// The arc on which a vertex swings, from where it is, past where it hangs.
void ClothOutlook::add_hanging(std::size_t v, Extent& extent) const {
    const auto [pin, far] = hanger(v);
    const Vec3 offset = positions_[v] - pin;
    const double along = offset.dot(outlook_.pull);
    const Vec3 across = offset - along * outlook_.pull;
    const double angle = std::atan2(across.norm(), along);
    const Vec3 side = across.norm() > 1e-9 * far ? across.normalized().eval() : Vec3::Zero().eval();
    const double overswing = 1.0 / (1.0 + outlook_.braking * far);
    const double reach = outlook_.distance(outlook_.end - outlook_.begin);
    for (int i = 0; i <= k_arc; ++i) {
        const double share = 1.0 - (1.0 + overswing) * i / k_arc; // 1: here, 0: hanging
        const double radius = far + std::abs(share) * (offset.norm() - far);
        const double at = share * angle;
        Vec3 x = pin + radius * (std::cos(at) * outlook_.pull + std::sin(at) * side);
        const double beyond = outlook_.down.dot(x) - deepest_[v];
        x -= std::max(0.0, beyond) * outlook_.down;
        const Vec3 way = x - positions_[v];
        if (way.norm() > reach) {
            x = positions_[v] + way * (reach / way.norm());
        }
        extent.extend(x);
        const double flutter = outlook_.aside.isZero() ? 0.0 : k_flutter * std::min(far, reach);
        for (const double sign : {-1.0, 1.0}) {
            if (flutter > 0.0) {
                extent.extend(x + sign * flutter * outlook_.aside);
                extent.extend(x + sign * flutter * outlook_.aside + 0.5 * flutter * outlook_.down);
            }
        }
    }
}

void ClothOutlook::add_falling(std::size_t v,
                               const Vec3& from,
                               double seconds,
                               Extent& extent) const {
    const double room = std::max(0.0, deepest_[v] - outlook_.down.dot(from));
    const double fall = std::min(outlook_.distance(seconds), room);
    const double in_air = seconds * (fall < room ? 1.0 : 0.0);
    extent.extend(from + fall * outlook_.down);
    extent.extend(from + fall * outlook_.down +
                  in_air *
                      (params_.velocity +
                       (scene_.scene.air_density > 0.0 ? scene_.scene.wind : Vec3::Zero().eval())));
}

/// What the pins of one group (-1: none) hold, carried with them.
Extent ClothOutlook::of_group(int group) const {
    Extent start;
    Extent released;
    const double until =
        group < 0 ? outlook_.begin
                  : std::max(outlook_.begin, params_.pins[static_cast<std::size_t>(group)].until);
    for (std::size_t v = 0; v < positions_.size(); ++v) {
        const Index source = to_pin_.source[v];
        if ((source == k_no_index ? -1 : holder_[static_cast<std::size_t>(source)]) != group) {
            continue;
        }
        start.extend(positions_[v]);
        Vec3 last = positions_[v];
        if (group >= 0) {
            add_hanging(v, start);
            const auto [pin, far] = hanger(v);
            last = pin + far * outlook_.pull;
        }
        if (until < outlook_.end) {
            add_falling(v, last, outlook_.end - until, released);
        }
    }
    Extent extent = start;
    extent.extend(released);
    if (group >= 0) {
        const PinParams& pin = params_.pins[static_cast<std::size_t>(group)];
        for (const double t : times_of_motion(scene_, outlook_.begin)) {
            const Pose way = carried(pin, scene_, outlook_.begin, t);
            for (const Vec3& x : start.points()) {
                extent.extend(way * x);
            }
        }
        const Pose way = carried(pin, scene_, outlook_.begin, outlook_.end);
        for (const Vec3& x : released.points()) {
            extent.extend(way * x);
        }
    }
    return extent;
}

Extent ClothOutlook::extent() const {
    Extent extent;
    for (int group = -1; group < static_cast<int>(params_.pins.size()); ++group) {
        extent.extend(of_group(group));
    }
    for (const FrameObject& object : objects_) {
        if (!object.reach.empty()) {
            extent.extend(taken_along(object, extent));
        }
    }
    return extent;
}

/// What cloth that is on a deforming obstacle, or pinned to it, reaches with it: as far beyond the
/// obstacle as now.
Box3 ClothOutlook::taken_along(const FrameObject& obstacle, const Extent& extent) const {
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

Extent obstacle_extent(const FrameObject& object,
                       const ObstacleParams& params,
                       const Scene& scene,
                       double begin) {
    const Extent start = object_extent(object);
    Extent extent = start;
    extent.extend(reach_extent(object));
    if (params.motion.empty() || !object.reach.empty()) {
        return extent;
    }
    for (const double t : times_of_motion(scene, begin)) {
        const Pose way = carried(params, begin, t);
        for (const Vec3& x : start.points()) {
            extent.extend(way * x);
        }
    }
    return extent;
}

} // namespace

Extent object_extent(const FrameObject& object) {
    Extent extent;
    for (const Vec3f& x : object.positions) {
        if (x.allFinite()) {
            extent.extend(x.cast<double>());
        }
    }
    return extent;
}

Extent predict_motion(const Frame& first, const Scene& scene, const std::vector<bool>& counts) {
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
            extent.extend(ClothOutlook(first, i, scene).extent());
        } else if (i < rigids) {
            const SolidParams& solid = scene.solids[i - solids];
            extent.extend(body_extent(first, i, {solid.velocity, solid.pins}, scene));
        } else if (i < obstacles) {
            extent.extend(body_extent(first, i, {scene.rigids[i - rigids].velocity, {}}, scene));
        } else {
            extent.extend(obstacle_extent(first.objects[i], scene.obstacles[i - obstacles], scene,
                                          first.time));
        }
    }
    return extent;
}

} // namespace weft
