#include "collide/islands.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace weft {

namespace {

/// Share of the time of impact up to which an island may move; nearer to 1 leaves less room.
constexpr double k_kept_share = 0.8;

/// v(x) = velocity + linear * (x - centre).
struct AffineMotion {
    Vec3 centre = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Mat3 linear = Mat3::Zero();

    Vec3 at(const Vec3& x) const { return velocity + linear * (x - centre); }
};

/// One island with impacts.
struct Cut {
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
        return !surface.is_deformable(v) ? 1.0
               : surface.carriers.of(v)  ? 0.0 // its particles have it
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
    Vec3 spin = Vec3::Zero();
    Mat3 inertia = Mat3::Zero();
    for (const Index v : vertices) {
        const double m = mass_of(v);
        const Vec3 r = surface.start[at(v)] - motion.centre;
        spin += m * r.cross(surface.velocity[at(v)] - motion.velocity);
        inertia += m * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    }
    // Vertices on a line have no inertia about it: there the turning speed is zero.
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(inertia);
    const double least = 1e-9 * axes.eigenvalues()[2];
    Vec3 turning = Vec3::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) {
        if (axes.eigenvalues()[k] > least) {
            const Vec3 axis = axes.eigenvectors().col(k);
            turning += axis.dot(spin) / axes.eigenvalues()[k] * axis;
        }
    }
    motion.linear << 0.0, -turning[2], turning[1], turning[2], 0.0, -turning[0], -turning[1],
        turning[0], 0.0;
    return motion;
}

void meet(Cut& cut, const ContactSurface& surface, Index v) {
    const Index object = surface.object_of_vertex[at(v)];
    if (!surface.is_deformable(v)) {
        if (cut.obstacle == k_no_index || moves(surface.objects[at(object)])) {
            cut.obstacle = object;
        }
        if (surface.objects[at(object)].deforms &&
            std::find(cut.met.begin(), cut.met.end(), v) == cut.met.end()) {
            cut.met.push_back(v);
        }
    } else {
        cut.held_sum += surface.velocity[at(v)];
        ++cut.held_count;
    }
}

std::vector<Cut> collect_cuts(const ContactSurface& surface,
                              std::span<const Candidate> candidates,
                              std::span<const Impact> impacts,
                              const Islands& islands) {
    std::vector<Cut> cuts;
    std::vector<Index> cut_of(at(surface.deformable_vertices), k_no_index);
    for (const Impact& impact : impacts) {
        const auto& vertices = candidates[at(impact.candidate)].vertices;
        const auto free = std::find_if(vertices.begin(), vertices.end(),
                                       [&](Index v) { return surface.inverse_mass[at(v)] > 0.0; });
        const Index island = islands.of(*free);
        Index& index = cut_of[at(island)];
        if (index == k_no_index) {
            index = static_cast<Index>(cuts.size());
            cuts.emplace_back();
        }
        Cut& cut = cuts[at(index)];
        cut.toi = std::min(cut.toi, impact.toi);
        for (const Index v : vertices) {
            if (surface.inverse_mass[at(v)] == 0.0) {
                meet(cut, surface, v);
            }
        }
    }
    for (Index v = 0; v < surface.deformable_vertices; ++v) {
        const Index index = cut_of[at(islands.of(v))];
        if (index != k_no_index && surface.inverse_mass[at(v)] > 0.0) {
            cuts[at(index)].vertices.push_back(v);
        }
    }
    return cuts;
}

AffineMotion reference_motion(const ContactSurface& surface, const Cut& cut, double dt) {
    if (cut.obstacle != k_no_index) {
        const ContactObject& obstacle = surface.objects[at(cut.obstacle)];
        return obstacle.deforms ? rigid_motion(surface, cut.met) : obstacle_motion(obstacle, dt);
    }
    if (cut.held_count > 0) {
        return {.velocity = cut.held_sum / cut.held_count};
    }
    return rigid_motion(surface, cut.vertices);
}

} // namespace

void Islands::reset(std::size_t vertex_count) {
    sets_.reset(vertex_count);
}

void Islands::reset(const ContactSurface& surface) {
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

void Islands::join(const ContactSurface& surface, const std::array<Index, 4>& vertices) {
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

Index Islands::of(Index vertex) const {
    return sets_.find(vertex);
}

int cut_back(ContactSurface& surface,
             std::span<const Candidate> candidates,
             std::span<const Impact> impacts,
             const Islands& islands,
             double strength,
             double dt,
             std::span<char> touched) {
    const std::vector<Cut> cuts = collect_cuts(surface, candidates, impacts, islands);
    for (const Cut& cut : cuts) {
        const double factor = strength * k_kept_share * cut.toi;
        const AffineMotion reference = reference_motion(surface, cut, dt);
        for (const Index v : cut.vertices) {
            const Vec3 base = reference.at(surface.start[at(v)]);
            surface.velocity[at(v)] = base + factor * (surface.velocity[at(v)] - base);
            touched[at(v)] = 1;
        }
    }
    return static_cast<int>(cuts.size());
}

} // namespace weft
