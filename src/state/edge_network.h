#pragma once

#include "base/eigen.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

enum class EdgeKind : std::uint8_t {
    Side,     ///< structural: an edge of the mesh, a step along an axis of the lattice
    Diagonal, ///< shear: across a quad of the import, a face or the inside of a lattice cell
    Bending,  ///< joins the apexes across an inner edge, or of a grid every other vertex
};

/// One edge of a network of particles.
struct NetworkEdge {
    std::array<Index, 2> vertices; ///< of the object alone
    double rest_length;            ///< m, > 0
    double stiffness;              ///< K of the edge, N/m, > 0
    EdgeKind kind;
};

/// The edges that hold an object of an edge model together, in the order in which they are summed.
using EdgeNetwork = std::vector<NetworkEdge>;

} // namespace weft
