#pragma once

#include "forces/cloth_forces.h"
#include "geometry/vertex_stars.h"

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

/// Elastic energy around one vertex of a cloth, as a function of where that vertex is: of the
/// membrane of its triangles, and of bending.
class VertexEnergy {
public:
    VertexEnergy(const Cloth& cloth, const VertexStars& stars, Index v, BendElements& bends);

    Index vertex() const { return vertex_; }

    /// Triangles around the vertex, ascending.
    const std::vector<Index>& star() const { return star_; }

    /// Of the membrane, J.
    /// @param x  #V, m
    double membrane(std::span<const Vec3> x) const;

    /// Elastic force on the vertex, N, and where its second derivative is asked for, that: bounded
    /// below by that of bending, and of a membrane that is not strained but tense, N/m.
    Vec3 force(std::span<const Vec3> x, Mat3* stiffness = nullptr) const;

    /// Change of the energy of bending by a shift of the vertex, J.
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
    std::vector<Coupled> coupled_; ///< others that bending ties the vertex to
    double own_q_ = 0.0;           ///< N/m
};

} // namespace weft
