#pragma once

#include "geometry/polar.h"
#include "scene/params.h"
#include "state/cloth.h"

/// One corotational triangle of orthotropic membrane: plane stress, linear in the strain S - I with
/// F = R S the deformation gradient from the rest plane (axis 0 weft, axis 1 warp).
///
///     W = A/2 e^T C e,   e = (S11 - 1, S22 - 1, 2 S12)
///
/// with C of membrane_stiffness(), state/cloth.h.
///
/// Source: corotational cloth after Etzmuss et al. 2003 and Bender and Deul 2013, but with the
/// exact gradient: the classic force -A R sigma g is a gradient only where sigma and S commute.
namespace weft {

using Corners = std::array<Vec3, 3>;

/// F = sum of x_i g_i^T, 3×2; with velocities for x, its rate.
Mat32 deformation_gradient(const Corners& x, const RestTriangle& rest);

/// sigma = C (S - I) on the rest axes, N/m.
struct MembraneStress {
    double s11, s12, s22;
};
MembraneStress membrane_stress(const PolarFactor& polar, const MembraneStiffness& c);

/// Z of the first Piola stress dW/dF = A R Z, N/m; isotropic: sigma itself.
Mat2 local_piola_stress(const PolarFactor& polar, const MembraneStress& stress);

/// W, J.
double membrane_energy(const Corners& x, const RestTriangle& rest, const MembraneStiffness& c);
double membrane_energy(const PolarFactor& polar, double rest_area, const MembraneStiffness& c);

/// Force on the corners, N: -dW/dx, and the damping -A F (C tau dE/dt) g_i with dE/dt the Green
/// strain rate. Both sum to no force and no torque; damping is zero in every rigid motion.
///
/// @param damping_time  tau, s, >= 0
Corners membrane_forces(const Corners& x,
                        const Corners& v,
                        const RestTriangle& rest,
                        const MembraneStiffness& c,
                        double damping_time);

/// The same where F and its polar factor are known.
Corners membrane_forces(const Mat32& F,
                        const PolarFactor& polar,
                        const Corners& v,
                        const RestTriangle& rest,
                        const MembraneStiffness& c,
                        double damping_time);

/// Deformation and tension of one triangle, for output.
struct StrainMeasures {
    double stretch_max, stretch_min; ///< principal stretches; 1 = rest
    double strain_weft, strain_warp; ///< change of length along the yarns, 0 = rest
    double shear_deg;                ///< 90 degrees minus the angle between the yarns
    double tension;                  ///< greatest principal stress, N/m; negative: compressed
};

/// Measures of a triangle with corners x (m). A yarn of no length has no shear angle (0).
StrainMeasures
strain_measures(const Corners& x, const RestTriangle& rest, const MembraneStiffness& c);

} // namespace weft
