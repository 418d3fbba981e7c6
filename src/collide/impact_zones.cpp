#include "collide/impact_zones.h"

#include "base/parallel.h"
#include "state/rigid_motion.h"

#include <algorithm>

namespace weft {

namespace {

/// False when the bounds of what the sides sweep show that they stay further apart than `reach`.
bool may_meet(PairKind kind, const PairPoints& start, const PairPoints& motion, double reach) {
    const std::size_t split = first_side(kind);
    for (Eigen::Index k = 0; k < 3; ++k) {
        std::array<double, 2> low{Box::k_empty, Box::k_empty};
        std::array<double, 2> high{-Box::k_empty, -Box::k_empty};
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t side = i < split ? 0 : 1;
            const double from = start[i][k];
            const double to = from + motion[i][k];
            low[side] = std::min({low[side], from, to});
            high[side] = std::max({high[side], from, to});
        }
        if (low[0] > high[1] + reach || low[1] > high[0] + reach) {
            return false;
        }
    }
    return true;
}

} // namespace

void ImpactSearch::find(const ContactSurface& surface,
                        std::span<const Candidate> candidates,
                        std::span<const char> look,
                        double dt,
                        const ImpactLimit& limit,
                        std::vector<Impact>& impacts) {
    impacts.clear();
    const auto look_at = [&](std::size_t i, std::vector<Impact>& found) {
        const auto& v = candidates[i].vertices;
        if (!look[at(v[0])] && !look[at(v[1])] && !look[at(v[2])] && !look[at(v[3])]) {
            return;
        }
        const double thickness = surface.thickness_of(v, candidates[i].kind);
        const PairPoints x = start_points(surface, v);
        const PairPoints motion = displacements(surface, v, dt);
        const ApproachLimit nearest{limit.thickness_fraction * thickness, limit.start_fraction};
        // Beyond the limit itself, the space that rounding needs.
        if (!may_meet(candidates[i].kind, x, motion, 1.01 * nearest.distance)) {
            return;
        }
        const auto toi = time_of_impact(candidates[i].kind, x, motion, nearest);
        if (toi && (*toi > 0.0 || separation(candidates[i].kind, x).distance > 0.0)) {
            found.push_back({static_cast<Index>(i), *toi});
        }
    };
    parallel_collect(candidates.size(), look_at, chunks_, impacts);
}

ContactRow
make_impact_row(const ContactSurface& surface, const Candidate& candidate, double toi, double dt) {
    PairPoints x = start_points(surface, candidate.vertices);
    const PairPoints motion = displacements(surface, candidate.vertices, dt);
    for (std::size_t i = 0; i < 4; ++i) {
        x[i] += toi * motion[i];
    }
    ContactRow row = make_row(surface, candidate, separation(candidate.kind, x), dt);
    row.least_speed = std::min(row.least_speed, 0.0);
    return row;
}

namespace {

/// Fraction of the time of impact up to which a zone may move; nearer to 1 leaves it less space.
constexpr double k_kept_fraction = 0.8;

/// v(x) = velocity + linear * (x - centre).
struct AffineMotion {
    Vec3 centre = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Mat3 linear = Mat3::Zero();

    Vec3 at(const Vec3& x) const { return velocity + linear * (x - centre); }
};

/// One zone with impacts.
struct MetZone {
    double toi = 1.0;
    Index obstacle = k_no_index; ///< object it meets; a moving one before a resting one
    std::vector<Index> met;      ///< vertices of the deforming obstacles it meets, each once
    Vec3 held_sum = Vec3::Zero();
    int held_count = 0;
    std::vector<Index> vertices;
};

bool moves(const ContactObject& object) {
    return object.deforms || object.start.rotation != object.end.rotation ||
           object.start.translation != object.end.translation;
}

/// The straight-line motion of an obstacle over the substep, continued to all of space.
AffineMotion obstacle_motion(const ContactObject& object, double dt) {
    AffineMotion motion;
    const Mat3 turn = object.end.rotation * object.start.rotation.transpose();
    motion.centre = object.start.translation;
    motion.velocity = (object.end.translation - object.start.translation) / dt;
    motion.linear = (turn - Mat3::Identity()) / dt;
    return motion;
}

/// Rigid motion with the momentum and angular momentum of the vertices. Those of obstacles count
/// alike.
AffineMotion rigid_motion(const ContactSurface& surface, std::span<const Index> vertices) {
    const auto mass_of = [&](Index v) {
        return !surface.is_deformable(v)    ? 1.0
               : surface.embeddings.find(v) ? 0.0 // its particles have it
                                            : 1.0 / surface.inverse_mass[at(v)];
    };
    AffineMotion motion;
    double mass = 0.0;
    for (const Index v : vertices) {
        const double m = mass_of(v);
        mass += m;
        motion.centre += m * surface.start[at(v)];
        motion.velocity += m * surface.velocity[at(v)];
    }
    motion.centre /= mass;
    motion.velocity /= mass;
    Vec3 angular = Vec3::Zero();
    Mat3 inertia = Mat3::Zero();
    for (const Index v : vertices) {
        const double m = mass_of(v);
        const Vec3 r = surface.start[at(v)] - motion.centre;
        angular += m * r.cross(surface.velocity[at(v)] - motion.velocity);
        inertia += m * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    }
    const Vec3 turning = spin_of(inertia, angular);
    motion.linear << 0.0, -turning[2], turning[1], turning[2], 0.0, -turning[0], -turning[1],
        turning[0], 0.0;
    return motion;
}

void meet(MetZone& zone, const ContactSurface& surface, Index v) {
    const Index object = surface.object_of_vertex[at(v)];
    if (!surface.is_deformable(v)) {
        if (zone.obstacle == k_no_index || moves(surface.objects[at(object)])) {
            zone.obstacle = object;
        }
        if (surface.objects[at(object)].deforms &&
            std::find(zone.met.begin(), zone.met.end(), v) == zone.met.end()) {
            zone.met.push_back(v);
        }
    } else {
        zone.held_sum += surface.velocity[at(v)];
        ++zone.held_count;
    }
}

std::vector<MetZone> collect_zones(const ContactSurface& surface,
                                   std::span<const Candidate> candidates,
                                   std::span<const Impact> impacts,
                                   const ImpactZones& zones) {
    std::vector<MetZone> met_zones;
    std::vector<Index> zone_number(at(surface.deformable_vertices), k_no_index);
    for (const Impact& impact : impacts) {
        const auto& vertices = candidates[at(impact.candidate)].vertices;
        const auto free = std::find_if(vertices.begin(), vertices.end(),
                                       [&](Index v) { return surface.inverse_mass[at(v)] > 0.0; });
        const Index name = zones.of(*free);
        Index& index = zone_number[at(name)];
        if (index == k_no_index) {
            index = static_cast<Index>(met_zones.size());
            met_zones.emplace_back();
        }
        MetZone& zone = met_zones[at(index)];
        zone.toi = std::min(zone.toi, impact.toi);
        for (const Index v : vertices) {
            if (surface.inverse_mass[at(v)] == 0.0) {
                meet(zone, surface, v);
            }
        }
    }
    for (Index v = 0; v < surface.deformable_vertices; ++v) {
        const Index index = zone_number[at(zones.of(v))];
        if (index != k_no_index && surface.inverse_mass[at(v)] > 0.0) {
            met_zones[at(index)].vertices.push_back(v);
        }
    }
    return met_zones;
}

AffineMotion reference_motion(const ContactSurface& surface, const MetZone& zone, double dt) {
    if (zone.obstacle != k_no_index) {
        const ContactObject& obstacle = surface.objects[at(zone.obstacle)];
        return obstacle.deforms ? rigid_motion(surface, zone.met) : obstacle_motion(obstacle, dt);
    }
    if (zone.held_count > 0) {
        return {.velocity = zone.held_sum / zone.held_count};
    }
    return rigid_motion(surface, zone.vertices);
}

} // namespace

void ImpactZones::reset(std::size_t vertex_count) {
    sets_.reset(vertex_count);
}

void ImpactZones::reset(const ContactSurface& surface) {
    reset(at(surface.deformable_vertices));
    for (const ContactBody& body : surface.bodies) {
        const auto join_all = [&](Index first, Index count) {
            for (Index v = first; v < first + count; ++v) {
                if (surface.inverse_mass[at(v)] > 0.0) {
                    sets_.join(v, body.first_vertex);
                }
            }
        };
        join_all(body.first_vertex, body.vertex_count);
        join_all(body.first_particle, body.particle_count);
    }
}

void ImpactZones::join(const ContactSurface& surface, const std::array<Index, 4>& vertices) {
    Index first = k_no_index;
    for (const Index v : vertices) {
        if (surface.inverse_mass[at(v)] == 0.0) {
            continue;
        }
        if (first == k_no_index) {
            first = v;
        }
        sets_.join(first, v);
    }
}

Index ImpactZones::of(Index vertex) const {
    return sets_.find(vertex);
}

int ImpactZones::scale_motion(ContactSurface& surface,
                              std::span<const Candidate> candidates,
                              std::span<const Impact> impacts,
                              double strength,
                              double dt,
                              std::span<char> touched) const {
    const std::vector<MetZone> met_zones = collect_zones(surface, candidates, impacts, *this);
    for (const MetZone& zone : met_zones) {
        const double factor = strength * k_kept_fraction * zone.toi;
        const AffineMotion reference = reference_motion(surface, zone, dt);
        for (const Index v : zone.vertices) {
            const Vec3 base = reference.at(surface.start[at(v)]);
            surface.velocity[at(v)] = base + factor * (surface.velocity[at(v)] - base);
            touched[at(v)] = 1;
        }
    }
    return static_cast<int>(met_zones.size());
}

} // namespace weft
