#pragma once

#include "geometry/triangle_mesh.h"
#include "scene/params.h"
#include "state/edge_network.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace weft {

struct World;

/// A surface vertex as a weighted sum of particles: its position is the sum of weight * position,
/// its velocity likewise.
struct Embedding {
    /// Indices within the body; k_no_index where there are fewer than four.
    std::array<Index, 4> particles{k_no_index, k_no_index, k_no_index, k_no_index};
    std::array<double, 4> weights{0.0, 0.0, 0.0, 0.0}; ///< sum to 1; 0 for k_no_index
};

/// A closed surface embedded in particles: only the particles have mass and degrees of freedom. The
/// surface is linear in them, so it moves on straight lines during a substep when they do.
///
/// Vertex i of the surface is World vertex first_vertex + i, particle k is World vertex
/// first_particle + k; all other indices count within this body.
struct Body {
    std::string name;
    Index first_vertex = 0, vertex_count = 0;
    Index first_particle = 0, particle_count = 0;
    std::vector<Triangle> triangles;
    EdgeTopology topology;
    std::vector<Embedding> embeddings; ///< #vertices
    double thickness = 1e-3;           ///< contact thickness, m
    double friction = 0.3, static_friction = 0.3;
    bool touches_itself = true; ///< false for a rigid body, which cannot
};

/// One cell of a lattice: eight particles, corner (x, y, z) at x + 2 y + 4 z.
using LatticeCell = std::array<Index, 8>;

/// A soft solid: particles of a lattice joined by edges.
struct Solid {
    Body body;
    SolidParams params;
    EdgeNetwork network;                ///< between particles
    std::vector<LatticeCell> cells;     ///< those whose eight corners are all particles
    std::vector<Vec3> rest_positions{}; ///< #particles, m
};

/// A rigid body: four particles of a quarter of its mass each. Their mass, centre and moments of
/// inertia are the body's, and a stiff energy keeps their distances to each other.
struct RigidBody {
    Body body;
    RigidParams params;
    std::array<Vec3, 4> rest; ///< particles relative to the centre of mass, m
    double stiffness = 0.0;   ///< stiffness of that energy, N/m
};

/// Sets the values of the body's embedded vertices from those of its particles. `values` is #V of
/// World long: positions or velocities.
void interpolate_embedded(const Body& body, std::span<Vec3> values);

/// The embeddings of all bodies of a world, by World vertex; particles have World indices here.
struct EmbeddingTable {
    std::vector<Index> slot; ///< #V, into `embeddings` or k_no_index; empty: nothing is embedded
    std::vector<Embedding> embeddings;

    /// The embedding of a vertex; null when the vertex is a degree of freedom itself.
    const Embedding* find(Index vertex) const {
        if (slot.empty()) {
            return nullptr;
        }
        const Index i = slot[at(vertex)];
        return i == k_no_index ? nullptr : &embeddings[at(i)];
    }
};

EmbeddingTable make_embedding_table(const World& world);

/// Renumbers the vertices of all bodies after cloths have gained or lost vertices: they follow
/// those of the last cloth, in the world's order.
void number_bodies(World& world);

} // namespace weft
