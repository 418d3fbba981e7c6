#pragma once

#include "forces/cloth_forces.h"
#include "geometry/mesh_edit.h"

#include <vector>

namespace weft {

/// The bending elements of a cloth, each made when it is first asked for.
class BendElements {
public:
    explicit BendElements(const Cloth& cloth)
        : cloth_(cloth), places_(ConstantBending::slot_count(cloth), 0) {}

    /// Valid until the next call.
    const BendElement& of(Index slot);

private:
    const Cloth& cloth_;
    std::vector<std::size_t> places_; ///< by slot, from 1; 0: not made yet
    std::vector<BendElement> made_;
};

/// Elastic energy of the elements around one vertex of a cloth, as a function of the position of
/// that vertex: membrane of its triangles, and bending.
class VertexEnergy {
public:
    VertexEnergy(const Cloth& cloth, const VertexStars& stars, Index v, BendElements& bends);

    Index vertex() const { return vertex_; }

    /// Triangles around the vertex, ascending.
    const std::vector<Index>& star() const { return star_; }

    /// Membrane energy of the star, J.
    /// @param x  #V, m
    double membrane(std::span<const Vec3> x) const;

    /// Elastic force on the vertex, N.
    /// @param stiffness  null, or receives an approximation of the second derivative of the energy,
    /// N/m,
    ///                   that is positive: bending, the unstrained membrane, and tension
    Vec3 force(std::span<const Vec3> x, Mat3* stiffness = nullptr) const;

    /// Change of bending energy by a shift of the vertex, J.
    double bending_change(std::span<const Vec3> x, const Vec3& shift) const;

private:
    Corners corners(Index t, std::span<const Vec3> x) const;
    Vec3 bending_gradient(std::span<const Vec3> x) const;
    void add_bends(BendElements& bends);
    void add_bend(const BendElement& bend);
    void add_coupling(Index other, double q);

    const Cloth& cloth_;
    MembraneStiffness stiffness_;
    Index vertex_;
    std::vector<Index> star_;
    struct Coupled {
        Index vertex;
        double q; ///< N/m
    };
    std::vector<Coupled> coupled_; ///< other vertices of the bending elements
    double own_q_ = 0.0;           ///< N/m
};

} // namespace weft
