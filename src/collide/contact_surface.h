#pragma once

#include "geometry/separation.h"
#include "state/carrier_table.h"

#include <span>

namespace weft {

/// One object in the unified surface.
struct ContactObject {
    std::string name;
    bool is_obstacle = false;
    Index first_vertex = 0, vertex_count = 0;     ///< of ContactSurface
    Index first_triangle = 0, triangle_count = 0; ///< of ContactSurface
    double thickness = 0.0;       ///< to obstacles, m; 0 for an obstacle, which takes the cloth's
    double least_thickness = 0.0; ///< to deformables, where the mesh is finest, m
    double friction = 0.0;        ///< Coulomb, kinetic
    double static_friction = 0.0; ///< Coulomb, of what rests
    Pose start{}, end{};          ///< of a rigid obstacle, over the substep
    Index body = k_no_index;      ///< of ContactSurface::bodies; none: cloth, obstacle
    bool touches_itself = true;   ///< false: it cannot
    bool deforms = false;         ///< an obstacle that changes its shape
    std::uint64_t motion_number = 0; ///< of a deforming obstacle: the same while it rests
};

/// What two objects agree on.
struct PairRule {
    double thickness; ///< wanted distance, m; of two deformables: where their meshes are coarse
    double friction;  ///< Coulomb, kinetic
    double static_friction; ///< Coulomb, of what rests; >= friction
    bool is_off = false;    ///< they do not touch each other
};

/// What carries the vertices of one object (Body).
struct ContactBody {
    Index first_vertex = 0, vertex_count = 0;     ///< of ContactSurface, as of World
    Index first_particle = 0, particle_count = 0; ///< likewise
    bool is_rigid = false;
    // of a rigid body, at the start of the substep:
    double mass = 0.0;                   ///< kg
    Vec3 centre = Vec3::Zero();          ///< m
    Mat3 inverse_inertia = Mat3::Zero(); ///< about it, 1/(kg m^2)
};

/// All surfaces as one: the vertices of all that moves by forces (as in World, particles that carry
/// others among them), then those of the obstacles; triangles likewise. Obstacle vertices are
/// vertices of infinite mass, like held ones. What moves by forces is called deformable here, rigid
/// bodies too.
struct ContactSurface {
    std::vector<ContactObject> objects; ///< cloths, solids, rigid bodies, obstacles, as in World
    std::vector<ContactBody> bodies;    ///< solids, then rigid bodies
    CarrierTable carriers;              ///< of deformable vertices
    std::vector<PairRule> rules;        ///< #objects x #objects, row by row
    Index deformable_vertices = 0;
    Index deformable_triangles = 0;
    std::vector<Index> object_of_vertex;
    /// Of each deformable vertex: wanted distance to deformables, m: the cloth's, lowered where the
    /// mesh is finer than it.
    std::vector<double> self_thickness;
    std::vector<Triangle> triangles;
    /// Of each triangle: bit k: it speaks for its corner k; bit 3 + k: for its side opposite to k.
    /// Each vertex and edge of the surface has one triangle that speaks for it.
    std::vector<std::uint8_t> owned;
    /// Of each triangle: the vertex across the side opposite to corner k; k_no_index on a boundary.
    std::vector<std::array<Index, 3>> across;
    /// Vertices joined to vertex v by an edge: ring[ring_begin[v]] to ring[ring_begin[v + 1]].
    std::vector<Index> ring_begin, ring;
    /// Vertices that a closed seam makes one with vertex v, ascending: joined[joined_begin[v]] to
    /// joined[joined_begin[v + 1]]. Both empty when there are none.
    std::vector<Index> joined_begin, joined;

    std::vector<Vec3> start;          ///< at the start of the substep, m
    std::vector<Vec3> velocity;       ///< along the substep, m/s
    std::vector<double> inverse_mass; ///< 1/kg; 0 = infinite; of a carried vertex alone

    bool owns_corner(Index triangle, std::size_t k) const {
        return (owned[static_cast<std::size_t>(triangle)] & (1 << k)) != 0;
    }
    bool owns_side(Index triangle, std::size_t k) const {
        return (owned[static_cast<std::size_t>(triangle)] & (8 << k)) != 0;
    }
    /// Is it one vertex to contact: the same, or sewn together?
    bool are_one(Index a, Index b) const {
        return a == b || (!joined_begin.empty() && are_joined(a, b));
    }
    bool are_joined(Index a, Index b) const;
    /// Is v, or what it is sewn to, a corner of t?
    bool has_corner(const Triangle& t, Index v) const {
        return are_one(t[0], v) || are_one(t[1], v) || are_one(t[2], v);
    }
    bool is_deformable(Index vertex) const { return vertex < deformable_vertices; }
    /// What carries a deformable vertex; none: nothing does.
    const ContactBody* body_of(Index vertex) const {
        const Index body =
            objects[static_cast<std::size_t>(object_of_vertex[static_cast<std::size_t>(vertex)])]
                .body;
        return body == k_no_index ? nullptr : &bodies[static_cast<std::size_t>(body)];
    }
    /// Two triangles of objects that do not touch each other?
    bool is_off(Index s, Index t) const {
        return !bodies.empty() &&
               rules[static_cast<std::size_t>(rule_of(triangles[static_cast<std::size_t>(s)][0],
                                                      triangles[static_cast<std::size_t>(t)][0]))]
                   .is_off;
    }
    /// Wanted distance of a pair, m.
    double thickness_of(const std::array<Index, 4>& pair, PairKind kind) const;
    Index rule_of(Index vertex_a, Index vertex_b) const {
        return object_of_vertex[static_cast<std::size_t>(vertex_a)] *
                   static_cast<Index>(objects.size()) +
               object_of_vertex[static_cast<std::size_t>(vertex_b)];
    }
};

/// The surface of a world, without motion. Friction between two objects is the contact table's, or
/// sqrt(mu_a mu_b) where it does not speak of them.
ContactSurface make_surface(const World& world, const ContactParams& contact = {});

/// Takes from the world which vertices its seams make one now.
void join_seams(ContactSurface& surface, const World& world);

/// Sets start, velocity, mass and joined vertices for the substep from world.time to world.time +
/// dt: deformables move with `velocities` (#V of World), obstacles on the straight line between
/// their places.
void place_surface(ContactSurface& surface,
                   const World& world,
                   std::span<const Vec3> velocities,
                   std::span<const char> held,
                   double dt);

/// Of each vertex of a cloth: largest contact thickness (m) below which a flat cloth at rest has no
/// pair in contact there: half the least altitude of the rest triangles around it.
std::vector<double> finest_thickness(const Cloth& cloth);

} // namespace weft
