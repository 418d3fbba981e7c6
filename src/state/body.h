#pragma once

#include "geometry/triangle_mesh.h"
#include "scene/params.h"
#include "state/edge_network.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// The particles that carry a surface vertex: it stands where their weighted sum is.
struct Carrier {
    std::array<Index, 4> particles{k_no_index, k_no_index, k_no_index, k_no_index}; ///< of the body
    std::array<double, 4> weights{0.0, 0.0, 0.0, 0.0}; ///< sum to 1; 0 where there is none
};

/// A closed surface carried by particles: only these have mass and are solved for. As the surface
/// is linear in them, it moves on straight lines during a substep when they do.
///
/// Vertex i of the surface is World vertex first_vertex + i, particle k is World vertex
/// first_particle + k; all other indices are of this body alone.
struct Body {
    std::string name;
    Index first_vertex = 0, vertex_count = 0;
    Index first_particle = 0, particle_count = 0;
    std::vector<Triangle> triangles;
    EdgeTopology topology;
    std::vector<Carrier> carriers; ///< #vertices
    double thickness = 1e-3;       ///< of contact, m
    double friction = 0.3, static_friction = 0.3;
    bool touches_itself = true; ///< false: it cannot
};

/// One cell of a lattice: eight particles, corner (x, y, z) at x + 2 y + 4 z.
using LatticeCell = std::array<Index, 8>;

/// A soft solid: particles of a lattice joined by edges.
struct Solid {
    Body body;
    SolidParams params;
    EdgeNetwork network;                ///< of particles
    std::vector<LatticeCell> cells;     ///< all of whose corners are particles
    std::vector<Vec3> rest_positions{}; ///< #particles, m
};

/// A rigid body: four particles of a quarter of its mass each, whose mass, centre and moments of
/// inertia are the body's, held in their places to each other.
struct RigidBody {
    Body body;
    RigidParams params;
    std::array<Vec3, 4> rest; ///< of the particles about the centre of mass, m
    double stiffness = 0.0;   ///< that holds them, N/m
};

/// Sets what stands for the body's carried vertices in `values` (by World vertex).
void carry(const Body& body, std::span<Vec3> values);

} // namespace weft
