#pragma once

#include "forces/elements.h"
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

/// Second derivative of W/A, split as it decouples exactly: in the triangle's plane a form in the
/// strain e = (dS11, dS22, 2 dS12) and the spin w, out of it a form in the slope of the normal
/// displacement, s = dF^T n:
///
///     d2W/A = e^T C e + 2 w h.e + spin w^2 + s^T [2Y] s        all in N/m
struct MembraneHessian {
    MembraneStiffness c;
    double h1 = 0.0, h2 = 0.0, h3 = 0.0, spin = 0.0;
    double y11 = 0.0, y12 = 0.0,
           y22 = 0.0; ///< 2 Y, the tension that holds the triangle in its plane
};

/// Ratio of least to greatest stretch below which the out-of-plane part is bounded; the exact one
/// grows without limit as a triangle collapses.
inline constexpr double k_thinnest = 2.5e-3;

/// The exact form (for triangles no thinner than k_thinnest).
MembraneHessian membrane_hessian(const PolarFactor& polar, const MembraneStiffness& c);

/// Makes the form positive semidefinite: the spin's stiffness is raised until its Schur complement
/// vanishes, negative tensions become zero. A form that is so already stays as it is, so Newton
/// keeps its second order under tension.
///
/// Keeping the spin's terms matters where tension outweighs shear stiffness: a 1 m sheet with a
/// shear modulus of 15 N/m hung by two corners under 10 g, at one linearisation a step of 10 ms,
/// still moves at 6.3 m/s after 2 s without them (the part left out is integrated explicitly) and
/// at 1.4 m/s with them; at 400 N/m and 1 g the two do not differ.
void project(MembraneHessian& hessian);

/// Energy, force (see membrane_forces) and the system blocks scales.stiffness * K +
/// scales.damping * D: K the projected second derivative of the energy, D = -df/dv (positive
/// semidefinite; how the damping force changes with position is left out).
///
/// @param damping_time  tau, s, >= 0
ElementTerms<3> membrane_terms(const Corners& x,
                               const Corners& v,
                               const RestTriangle& rest,
                               const MembraneStiffness& c,
                               double damping_time,
                               SystemScales scales);

/// The blocks of a given form, times `scale`.
std::array<Mat3, 6> membrane_blocks(const MembraneHessian& hessian,
                                    const PolarFactor& polar,
                                    const RestTriangle& rest,
                                    double scale);

/// One triangle of a cloth's membrane by itself (forces/elements.h says what elements have).
struct MembraneTriangle {
    static constexpr int count = 3; ///< nodes

    Triangle nodes;
    RestTriangle rest;
    MembraneStiffness stiffness;

    Index node(int a) const { return nodes[at(a)]; }
    bool has(int) const { return true; }
    bool empty() const { return false; }
    Corners corners(std::span<const Vec3> x) const {
        return {x[at(nodes[0])], x[at(nodes[1])], x[at(nodes[2])]};
    }

    /// J. @param x  #V of the cloth, m
    double energy(std::span<const Vec3> x) const {
        return membrane_energy(corners(x), rest, stiffness);
    }

    /// Calls f(node, elastic force in N) for each corner.
    template <typename F> void for_each_force(std::span<const Vec3> x, const F& f) const {
        const Corners still{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
        const Corners forces = membrane_forces(corners(x), still, rest, stiffness, 0.0);
        for (std::size_t k = 0; k < 3; ++k) {
            f(nodes[k], forces[k]);
        }
    }
};

/// The membrane of a whole cloth: one element a triangle.
class MembraneElements : public ElementLoops<MembraneElements, 3> {
public:
    explicit MembraneElements(const Cloth& cloth);

    static std::size_t slot_count(const Cloth& cloth) { return cloth.triangles.size(); }
    static std::vector<Index> changed_slots(const Cloth&, const ClothChanges& changes) {
        return changes.triangles;
    }
    static MembraneTriangle element(const Cloth& cloth, Index slot) {
        return {cloth.triangles[at(slot)], cloth.rest[at(slot)],
                membrane_stiffness(cloth.params.fabric)};
    }

    std::vector<Index> remesh(const Cloth& cloth, const ClothChanges& changes);

    double energy_of(std::size_t t, std::span<const Vec3> x) const;
    Corners force_of(std::size_t t, std::span<const Vec3> x, std::span<const Vec3> v) const;
    ElementTerms<3> terms_of(std::size_t t,
                             std::span<const Vec3> x,
                             std::span<const Vec3> v,
                             SystemScales scales) const;

private:
    MembraneStiffness stiffness_;
    double damping_time_; ///< s
    std::vector<RestTriangle> rest_;
};

} // namespace weft
