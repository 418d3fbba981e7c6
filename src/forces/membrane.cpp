#include "forces/membrane.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

// The gradient. dW = A sigma : dS with S dS + dS S = F^T dF + dF^T F, hence with the symmetric Y of
// S Y + Y S = sigma it is dW/dF = 2 A F Y = A R (2 S Y). In two dimensions
//
//     2 S Y = (S sigma + sigma adj S) / tr S
//
// which divides by nothing smaller than tr S: a triangle may collapse onto a line.

namespace weft {

namespace {

/// F (C tau dE/dt): the damping part of the first Piola stress.
Mat32 damping_stress(const Mat32& F, const Mat32& rate, const MembraneStiffness& c, double tau) {
    const double e1 = tau * F.col(0).dot(rate.col(0));
    const double e2 = tau * F.col(1).dot(rate.col(1));
    const double shear = tau * c.c33 * (F.col(0).dot(rate.col(1)) + F.col(1).dot(rate.col(0)));
    Mat32 P;
    P.col(0) = F.col(0) * (c.c11 * e1 + c.c12 * e2) + F.col(1) * shear;
    P.col(1) = F.col(0) * shear + F.col(1) * (c.c12 * e1 + c.c22 * e2);
    return P;
}

} // namespace

Mat32 deformation_gradient(const Corners& x, const RestTriangle& rest) {
    const Vec3 d1 = x[1] - x[0];
    const Vec3 d2 = x[2] - x[0];
    const Mat2& g = rest.inverse_edges;
    Mat32 F;
    F.col(0) = d1 * g(0, 0) + d2 * g(1, 0);
    F.col(1) = d1 * g(0, 1) + d2 * g(1, 1);
    return F;
}

MembraneStress membrane_stress(const PolarFactor& polar, const MembraneStiffness& c) {
    const double e1 = polar.s11 - 1.0;
    const double e2 = polar.s22 - 1.0;
    return {c.c11 * e1 + c.c12 * e2, 2.0 * c.c33 * polar.s12, c.c12 * e1 + c.c22 * e2};
}

Mat2 local_piola_stress(const PolarFactor& polar, const MembraneStress& s) {
    const double trace = polar.s11 + polar.s22;
    const double inverse = trace > 0.0 ? 1.0 / trace : 0.0;
    const double twist = polar.s12 * (s.s22 - s.s11);
    Mat2 Z;
    Z << s.s11, (2.0 * polar.s11 * s.s12 + twist) * inverse, //
        (2.0 * polar.s22 * s.s12 - twist) * inverse, s.s22;
    return Z;
}

double membrane_energy(const PolarFactor& polar, double rest_area, const MembraneStiffness& c) {
    const MembraneStress s = membrane_stress(polar, c);
    return 0.5 * rest_area *
           (s.s11 * (polar.s11 - 1.0) + s.s22 * (polar.s22 - 1.0) + 2.0 * s.s12 * polar.s12);
}

double membrane_energy(const Corners& x, const RestTriangle& rest, const MembraneStiffness& c) {
    return membrane_energy(polar_decompose(deformation_gradient(x, rest)), rest.area, c);
}

Corners membrane_forces(const Mat32& F,
                        const PolarFactor& polar,
                        const Corners& v,
                        const RestTriangle& rest,
                        const MembraneStiffness& c,
                        double damping_time) {
    const Mat2 Z = local_piola_stress(polar, membrane_stress(polar, c));
    Mat32 P;
    P.col(0) = polar.R.col(0) * Z(0, 0) + polar.R.col(1) * Z(1, 0);
    P.col(1) = polar.R.col(0) * Z(0, 1) + polar.R.col(1) * Z(1, 1);
    if (damping_time > 0.0) {
        P += damping_stress(F, deformation_gradient(v, rest), c, damping_time);
    }
    const Mat2& g = rest.inverse_edges;
    const Vec3 f1 = -rest.area * (P.col(0) * g(0, 0) + P.col(1) * g(0, 1));
    const Vec3 f2 = -rest.area * (P.col(0) * g(1, 0) + P.col(1) * g(1, 1));
    return {Vec3(-f1 - f2), f1, f2};
}

Corners membrane_forces(const Corners& x,
                        const Corners& v,
                        const RestTriangle& rest,
                        const MembraneStiffness& c,
                        double damping_time) {
    const Mat32 F = deformation_gradient(x, rest);
    return membrane_forces(F, polar_decompose(F), v, rest, c, damping_time);
}

StrainMeasures
strain_measures(const Corners& x, const RestTriangle& rest, const MembraneStiffness& c) {
    const Mat32 F = deformation_gradient(x, rest);
    const Vec2 stretch = principal_stretches(F);
    const MembraneStress s = membrane_stress(polar_decompose(F), c);
    StrainMeasures measures{};
    measures.stretch_max = stretch(0);
    measures.stretch_min = stretch(1);
    const double weft = F.col(0).norm();
    const double warp = F.col(1).norm();
    measures.strain_weft = weft - 1.0;
    measures.strain_warp = warp - 1.0;
    if (weft > 0.0 && warp > 0.0) {
        const double cosine = std::clamp(F.col(0).dot(F.col(1)) / (weft * warp), -1.0, 1.0);
        measures.shear_deg = std::asin(cosine) * 180.0 / std::numbers::pi;
    }
    measures.tension = 0.5 * (s.s11 + s.s22) + std::hypot(0.5 * (s.s11 - s.s22), s.s12);
    return measures;
}

} // namespace weft
