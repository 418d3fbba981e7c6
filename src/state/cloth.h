#pragma once

#include "geometry/triangle_mesh.h"
#include "scene/params.h"
#include "state/edge_network.h"
#include "state/refinement.h"
#include "state/rest_triangle.h"

#include <string>
#include <vector>

namespace weft {

/// One cloth: its topology and rest shape. Positions and velocities stand in World; vertex i here
/// is World vertex first_vertex + i, and all indices below are of this cloth alone.
struct Cloth {
    std::string name;
    ClothParams params;
    Index first_vertex = 0;
    Index vertex_count = 0;
    std::vector<Triangle> triangles;
    EdgeTopology topology;
    std::vector<RestTriangle> rest; ///< #triangles
    std::vector<Vec2>
        material_positions;         ///< #vertices, u, m: for output (a seam vertex has its first)
    std::vector<double> rest_areas; ///< #vertices, mixed Voronoi area of the rest shape, m^2
    Refinement refinement;          ///< empty where the mesh does not adapt
    EdgeNetwork network;            ///< of edge models; else empty
};

/// Level of refinement of a triangle: 0 as imported, each higher one a third as large.
inline int triangle_level(const Cloth& cloth, Index t) {
    return cloth.refinement.empty()
               ? 0
               : level_of(cloth.refinement.triangles[static_cast<std::size_t>(t)].generation);
}

/// Equivalent stiffness of a fabric under tension, the mean over weft and warp, N/m.
inline double mean_stretch_stiffness(const FabricParams& fabric) {
    return 0.5 * fabric.stretch_stiffness.sum();
}

/// How stiff a cloth's material is under tension, N/m: its fabric, or a spring of an edge model.
inline double material_stiffness(const ClothParams& params) {
    return params.model == Model::Corotational ? mean_stretch_stiffness(params.fabric)
                                               : params.spring.K;
}

} // namespace weft
