#pragma once

#include "geometry/triangle_mesh.h"
#include "scene/params.h"
#include "state/edge_network.h"
#include "state/refinement.h"
#include "state/rest_shape.h"

#include <string>
#include <vector>

namespace weft {

/// One cloth: its topology and rest shape. World holds its positions and velocities: vertex i is
/// World vertex first_vertex + i. All other indices count within this cloth.
struct Cloth {
    std::string name;
    ClothParams params;
    Index first_vertex = 0;
    Index vertex_count = 0;
    std::vector<Triangle> triangles;
    EdgeTopology topology;
    std::vector<RestTriangle> rest; ///< #triangles
    std::vector<Vec2>
        material_positions; ///< #vertices, u, m, for output; a vertex on a seam has its first
    std::vector<double> rest_areas; ///< #vertices, mixed Voronoi area of the rest shape, m^2
    Refinement refinement;          ///< empty when the mesh does not adapt
    EdgeNetwork network;            ///< empty when the model is not an edge model
};

/// Plane-stress moduli of a fabric, N/m: C = [[c11, c12, 0], [c12, c22, 0], [0, 0, c33]], positive
/// definite.
struct MembraneStiffness {
    double c11, c12, c22, c33;
};

/// C from Young's moduli (times thickness) along weft and warp, shear modulus and
/// poisson = sqrt(nu12 nu21); E1 nu21 = E2 nu12 makes it symmetric.
MembraneStiffness membrane_stiffness(const FabricParams& fabric);

/// Refinement level of a triangle: 0 as imported; each level has a third of the area of the last.
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
