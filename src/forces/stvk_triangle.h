#pragma once

#include "forces/elements.h"
#include "forces/membrane.h"

namespace weft {

/// One Saint Venant-Kirchhoff triangle: stress linear in the Green strain of the deformation
/// gradient F = [U V] (3×2, axis 0 weft, axis 1 warp),
///
///     W = A/2 e^T C e,   e = ((U.U - 1)/2, (V.V - 1)/2, U.V)
///
/// Like every such law it loses its stiffness under compression: along an axis below the stretch
/// 0.577. Source: Volino et al. 2009.
double stvk_energy(const Corners& x, const RestTriangle& rest, const MembraneStiffness& c);

/// Energy, force and the system blocks scales.stiffness * K + scales.damping * D.
///
/// K is the second derivative of the energy with the stress of its geometric part made positive
/// semidefinite: exact where the triangle is not compressed.
///
/// @param damping  N s/m: each of two triangles at an edge gives half of a force
///                 -damping (v0 - v1) on end 0, as an edge's own (edge_terms)
ElementTerms<3> stvk_terms(const Corners& x,
                           const Corners& v,
                           const RestTriangle& rest,
                           const MembraneStiffness& c,
                           double damping,
                           SystemScales scales);

/// The same force without the blocks.
Corners stvk_forces(const Corners& x,
                    const Corners& v,
                    const RestTriangle& rest,
                    const MembraneStiffness& c,
                    double damping);

/// Moduli of cloth of this model. From K: those of a network of equilateral triangles whose edges
/// have stiffness K, so that it compares with the models of edges,
///
///     Young's modulus (times thickness) 2 K / sqrt 3, poisson 1/3, shear sqrt(3)/4 K.
///
/// With `calibrate` the moduli are those of the fabric.
MembraneStiffness stvk_stiffness(const ClothParams& cloth);

/// The Saint Venant-Kirchhoff triangles of a whole cloth. Cloth of this model does not adapt.
class StvkTriangleElements : public ElementLoops<StvkTriangleElements, 3> {
public:
    explicit StvkTriangleElements(const Cloth& cloth);

    double energy_of(std::size_t t, std::span<const Vec3> x) const;
    Corners force_of(std::size_t t, std::span<const Vec3> x, std::span<const Vec3> v) const;
    ElementTerms<3> terms_of(std::size_t t,
                             std::span<const Vec3> x,
                             std::span<const Vec3> v,
                             SystemScales scales) const;

private:
    MembraneStiffness stiffness_;
    double damping_; ///< N s/m
    std::vector<RestTriangle> rest_;
};

} // namespace weft
