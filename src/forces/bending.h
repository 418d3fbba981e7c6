#pragma once

#include "base/eigen.h"
#include "forces/elements.h"

#include <array>

/// Bending stencils whose energy is quadratic in the positions: E = 1/2 sum Q_ab x_a.x_b with Q
/// constant, from the rest shape alone. Rest shapes are flat. Everything is intrinsic: corners of
/// rest triangles, each in a plane of its own.
///
/// The jump of an inner edge, j = K x, is the sum of the unit conormals of its two triangles times
/// the edge's length: |j| = 2 L sin(theta / 2) with theta the dihedral angle, if lengths are kept.
namespace weft {

using RestCorners = std::array<Vec2, 3>;

/// Cotangent of the angle at corner k of a triangle.
double rest_cotangent(const RestCorners& corners, int k);

/// K of an edge (x0, x1) with apexes x2 and x3, in this order; annihilates affine functions.
/// @param cot0, cot1  cotangents at x0 and at x1, each in the triangle of x2 and in that of x3
std::array<double, 4> edge_jump(const std::array<double, 2>& cot0,
                                const std::array<double, 2>& cot1);

/// Q (upper triangle, row by row, N/m) of the two-triangle stencil: D / (A0 + A1) K^T K.
///
/// On cylinders it gives the plate energy D/2 kappa^2 per area where the mesh is regular, up to
/// three times as much where the curvature runs along its diagonals; its Poisson ratio is -1/3.
/// Source: Bergou et al. 2006, "A quadratic bending model for inextensible surfaces", with
/// k = D/3 for the coefficient 3 k / (A0 + A1) so that D is the physical rigidity.
std::array<double, 10>
hinge_bend_stiffness(const std::array<double, 4>& jump, double area_sum, double rigidity);

/// A triangle and its neighbours, as the six-node stencil needs them. Nodes: the three corners,
/// then the apex across the edge opposite to corner 0, 1, 2.
struct BendPatch {
    RestCorners corners;
    std::array<bool, 3> has_neighbour;
    std::array<RestCorners, 3> neighbours; ///< [k]: corner 0 is the far apex, 1 and 2 are the
                                           ///< triangle's corners k+2 and k+1
};

/// Weight of the mid-edge operator in the six-node stencil against being exact for quadratic
/// surfaces; 0: exact for each of them, infinite: mid-edge weights. Deflection of a
/// cantilever (20 cells long; right = 1) on a union-jack grid and on three irregular meshes:
///     infinite: 1.00 0.97 0.94 0.92    14: 1.02 1.00 0.98 0.98    0: 1.27 1.06 1.04 1.07
/// and the energy of a cylinder at 45 degrees on the union-jack grid: 1.50, 1.30, 1.00.
inline constexpr double k_mid_edge_weight = 14.0;

/// Q (upper triangle, row by row, N/m) of one triangle's plate energy D A/2 |B|^2, with the
/// curvature B = sum over its edges of M_e (K_e x) constant on the triangle and bending Poisson
/// ratio 0. M starts from the mid-edge weights w_e / A_t n_e n_e^T, w_e = A_t / (A_t +
/// A_neighbour), n_e the edge's normal in the rest plane, and is moved towards B = the second
/// derivatives of every quadratic surface over the six nodes. An edge without a neighbour has no
/// moment (the natural condition of a free edge) and leaves its triangle with the mid-edge weights.
///
/// Exact on cylinders over meshes of parallelograms cut along one diagonal, in every direction.
/// Source: mid-edge (rotation-free) plate operator, Onate and Zarate 2000; the correction is ours.
std::array<double, 21> mid_edge_bend_stiffness(const BendPatch& patch, double rigidity);

/// Force -c dtheta/dt grad theta of one hinge on (x0, x1, x2, x3) and scales.damping times its
/// matrix c grad grad^T; no elastic part. Zero for every rigid motion, without torque, positive
/// semidefinite.
///
/// @param damping     c, N m s, >= 0
/// @param least_area  m^2: the gradient of a hinge whose triangles have collapsed below this is
///                    scaled down, because it grows as one over their heights
ElementTerms<4> hinge_damping_terms(const std::array<Vec3, 4>& x,
                                    const std::array<Vec3, 4>& v,
                                    double damping,
                                    double least_area,
                                    SystemScales scales);

/// Damping of bending over a whole cloth: a hinge an edge with c = tau D L^2 / (A0 + A1), tau the
/// fabric's stiffness damping; on the boundary c = 0 and all nodes are k_no_index. The constant
/// matrix of the elastic part cannot serve for this: -tau Q v brakes the rotation of a bent sheet.
class BendDampingElements : public ElementLoops<BendDampingElements, 4> {
public:
    /// No elements when the fabric's damping or rigidity is zero.
    explicit BendDampingElements(const Cloth& cloth);

    std::vector<Index> remesh(const Cloth& cloth, const ClothChanges& changes);

    ElementTerms<4> terms_of(std::size_t hinge,
                             std::span<const Vec3> x,
                             std::span<const Vec3> v,
                             SystemScales scales) const;

private:
    struct Hinge {
        double damping;    ///< N m s
        double least_area; ///< m^2
    };
    void resize(const Cloth& cloth);
    void set_hinge(const Cloth& cloth, Index edge);

    double stiffness_; ///< tau D, N m s
    std::vector<Hinge> hinges_;
};

} // namespace weft
