#pragma once

#include "base/eigen.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

struct Cloth;

enum class EdgeKind : std::uint8_t {
    Side,     ///< structural: an edge of the mesh, a step along an axis of the lattice
    Diagonal, ///< shear: across a quad of the import, a face or the inside of a lattice cell
    Bending,  ///< joins the apexes across an inner edge, or of a grid every other vertex
};

/// One edge of a network of particles.
struct NetworkEdge {
    std::array<Index, 2> vertices; ///< the object's own indices
    double rest_length;            ///< m, > 0
    double stiffness;              ///< K, N/m, > 0
    EdgeKind kind;
};

/// The edges that hold an object of an edge model together, in the order in which they are summed.
using EdgeNetwork = std::vector<NetworkEdge>;

/// The edge network of a cloth with an edge model, by its rest shape:
///
/// - sides: the edges of the mesh except those that cut a quad of the import in two;
/// - diagonals: both diagonals of each quad, with `spring.shear` times K; none where that is 0;
/// - bending edges, with K = `spring.bend`. In a grid they join each vertex to the second next in
///   its row and column; in a mesh they join the apexes across each side with two triangles, with
///   the distance that these have when the triangles lie flat. There are none where `bend` is 0 or
///   where another edge is.
///
/// stvk_triangle has bending edges only. With `spring.calibrate` calibrate_network() gives K of
/// sides and diagonals.
///
/// @param polygons  #T, the polygon of the import that each triangle was cut from
EdgeNetwork cloth_network(const Cloth& cloth, std::span<const Index> polygons);

} // namespace weft
