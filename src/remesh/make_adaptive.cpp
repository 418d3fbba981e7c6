#include "remesh/make_adaptive.h"

#include "adapt/adaptive_cloth.h"
#include "geometry/curvature.h"

#include <cmath>
#include <numbers>

namespace weft {

namespace {

/// An inner edge of an imported shape that turns by more than this is a crease, rad. A flip across
/// it would put a stretched triangle over a fold that is meant to be there; smaller keeps edges of
/// round garments (a tube of six sides turns by 60 degrees) from flipping, which they should.
constexpr double k_crease = 65.0 * std::numbers::pi / 180.0;

/// Where cloth rests as imported, its creases are part of its shape.
void lock_creases(const World& world, Cloth& cloth) {
    if (cloth.params.rest != RestShape::Mesh) {
        return;
    }
    const auto x = world.positions_of(cloth);
    for (std::size_t e = 0; e < cloth.topology.edges.size(); ++e) {
        const MeshEdge& edge = cloth.topology.edges[e];
        if (!edge.is_boundary() &&
            std::abs(dihedral_angle(x[at(edge.v[0])], x[at(edge.v[1])], x[at(edge.apex[0])],
                                    x[at(edge.apex[1])])) > k_crease) {
            cloth.refinement.locked[e] = 1;
        }
    }
}

void freeze_attached(World& world, Cloth& cloth) {
    std::vector<char> attached(at(cloth.vertex_count), 0);
    for (const AttachedPair& pair : world.attached_pairs) {
        for (const Index v : pair.vertices) {
            if (v >= cloth.first_vertex && v < cloth.first_vertex + cloth.vertex_count) {
                attached[at(v - cloth.first_vertex)] = 1;
            }
        }
    }
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        for (const Index v : cloth.triangles[t]) {
            cloth.refinement.frozen[t] |= static_cast<std::uint8_t>(attached[at(v)]);
        }
    }
}

} // namespace

void make_adaptive(World& world) {
    for (Cloth& cloth : world.cloths) {
        if (cloth.params.adapt.levels > 0 && cloth.refinement.empty()) {
            make_refinement(cloth);
            const auto x = world.positions_of(cloth);
            cloth.refinement.start.assign(x.begin(), x.end());
            lock_creases(world, cloth);
            freeze_attached(world, cloth);
        }
    }
}

} // namespace weft
