#pragma once

#include "geometry/distance.h"
#include "state/body.h"
#include "state/world.h"

#include <span>

namespace weft {

/// One object in the unified surface.
struct ContactObject {
    std::string name;
    ObjectId id;
    Index first_vertex = 0, vertex_count = 0;     ///< in ContactSurface
    Index first_triangle = 0, triangle_count = 0; ///< in ContactSurface
    double thickness =
        0.0; ///< wanted distance to obstacles, m; an obstacle has 0: the other's counts
    double least_thickness = 0.0;    ///< wanted distance to deformables where the mesh is finest, m
    double friction = 0.0;           ///< Coulomb, kinetic
    double static_friction = 0.0;    ///< Coulomb, while it sticks
    Pose start{}, end{};             ///< a rigid obstacle's, over the substep
    Index body = k_no_index;         ///< in ContactSurface::bodies; none: cloth, obstacle
    bool touches_itself = true;      ///< false: its surface cannot meet itself
    bool deforms = false;            ///< an obstacle that changes its shape
    std::uint64_t motion_number = 0; ///< changes whenever a deforming obstacle moves
};

/// How two objects meet.
struct PairRule {
    double thickness; ///< wanted distance, m; of two deformables: where their meshes are coarse
    double friction;  ///< Coulomb, kinetic
    double static_friction; ///< Coulomb, while they stick; >= friction
    bool is_off = false;    ///< they do not touch each other
};

/// The particles that carry the vertices of a solid or a rigid body (Body).
struct ContactBody {
    Index first_vertex = 0, vertex_count = 0;     ///< in ContactSurface, as in World
    Index first_particle = 0, particle_count = 0; ///< likewise
    bool is_rigid = false;
    // only a rigid body has these; as the substep starts:
    double mass = 0.0;                   ///< kg
    Vec3 centre = Vec3::Zero();          ///< m
    Mat3 inverse_inertia = Mat3::Zero(); ///< about it, 1/(kg m^2)
};

/// All surfaces as one: the vertices of all that moves by forces (as in World, particles that carry
/// others among them), then those of the obstacles; triangles likewise. Obstacle vertices are
/// vertices of infinite mass, like held ones. What moves by forces is called deformable here, rigid
/// bodies too.
struct ContactSurface {
    std::vector<ContactObject> objects;   ///< in the order of objects_of(world)
    std::array<Index, 4> first_of_kind{}; ///< number in `objects` of the first one of each kind
    std::vector<ContactBody> bodies;      ///< solids, then rigid bodies
    EmbeddingTable embeddings;            ///< the embedding of deformable vertices
    std::vector<PairRule> rules;          ///< #objects x #objects, row by row
    Index deformable_vertices = 0;
    Index deformable_triangles = 0;
    std::vector<Index> object_of_vertex;
    /// #V deformable: wanted distance to deformables, m; the cloth's thickness, less where its mesh
    /// is finer.
    std::vector<double> self_thickness;
    std::vector<Triangle> triangles;
    /// #T flags: bit k says that the triangle represents its corner k, bit 3 + k that it represents
    /// its side opposite to k. One triangle represents each vertex and each edge of the surface.
    std::vector<std::uint8_t> owned;
    /// #T: the neighbour's vertex opposite to the side that is opposite to corner k; k_no_index on
    /// a boundary.
    std::vector<std::array<Index, 3>> opposite;
    /// Vertices joined to vertex v by an edge: ring[ring_begin[v]] to ring[ring_begin[v + 1]].
    std::vector<Index> ring_begin, ring;
    /// Vertices that a closed seam makes one with vertex v, ascending: joined[joined_begin[v]] to
    /// joined[joined_begin[v + 1]]. Both empty when there are none.
    std::vector<Index> joined_begin, joined;

    std::vector<Vec3> start;          ///< at the start of the substep, m
    std::vector<Vec3> velocity;       ///< along the substep, m/s
    std::vector<double> inverse_mass; ///< 1/kg; 0 = infinite; an embedded vertex's own, alone

    bool owns_corner(Index triangle, std::size_t k) const {
        return (owned[static_cast<std::size_t>(triangle)] & (1 << k)) != 0;
    }
    bool owns_side(Index triangle, std::size_t k) const {
        return (owned[static_cast<std::size_t>(triangle)] & (8 << k)) != 0;
    }
    /// Are the two one vertex to contact: the same, or sewn together?
    bool are_one(Index a, Index b) const {
        return a == b || (!joined_begin.empty() && are_joined(a, b));
    }
    bool are_joined(Index a, Index b) const;
    /// Is v, or what it is sewn to, a corner of t?
    bool has_corner(const Triangle& t, Index v) const {
        return are_one(t[0], v) || are_one(t[1], v) || are_one(t[2], v);
    }
    /// Number of an object in `objects`.
    Index number_of(ObjectId object) const {
        return first_of_kind[static_cast<std::size_t>(object.kind)] + object.index;
    }
    bool is_deformable(Index vertex) const { return vertex < deformable_vertices; }
    /// The body that carries a deformable vertex; null: none does.
    const ContactBody* body_of(Index vertex) const {
        const Index body =
            objects[static_cast<std::size_t>(object_of_vertex[static_cast<std::size_t>(vertex)])]
                .body;
        return body == k_no_index ? nullptr : &bodies[static_cast<std::size_t>(body)];
    }
    /// Do the two triangles belong to objects that do not touch each other?
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

/// #V of the cloth: the largest contact thickness (m) at which a flat cloth at rest has no pair in
/// contact at the vertex: half the least altitude of the rest triangles around it.
std::vector<double> finest_thickness(const Cloth& cloth);

/// One line for the user for each cloth whose mesh is finer than its contact thickness, so that
/// less is used between cloth and cloth.
std::vector<std::string> thickness_warnings(const World& world, const ContactParams& contact);

} // namespace weft
