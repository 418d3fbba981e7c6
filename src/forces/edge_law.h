#pragma once

#include "forces/elements.h"
#include "scene/law_shape.h"
#include "state/body.h"
#include "state/cloth.h"
#include "state/edge_network.h"
#include "state/refinement.h"

#include <algorithm>
#include <cmath>

/// The force along one edge that joins two particles: Vogiannou et al. 2010, and the two laws that
/// they compare it with. With r the length now and L at rest, s = r / L,
///
///     force on end 0 = -g(r) (x0 - x1) / r        and the opposite on end 1
///     df0/dx1 = H = (g / r) (I - n n^T) + g' n n^T,   df0/dx0 = -H
///
/// with the tension g positive under stretch. As printed, (2) of the paper has the opposite sign,
/// which fits neither its curves nor its Jacobian (3).
namespace weft {

/// Energy (J), tension (N) and stiffness (N/m) along an edge at some length.
struct EdgeResponse {
    double energy = 0.0, tension = 0.0, stiffness = 0.0;
};

/// The law alone at stretch s >= 0, without limits; in powers of s - 1, which do not cancel near
/// rest.
/// @param stiffness  K, N/m
/// @param rest_length  L, m, > 0
inline EdgeResponse
edge_response(const LawShape& shape, double stiffness, double rest_length, double s) {
    const double e = s - 1.0;
    const double kl = stiffness * rest_length;
    return {kl * rest_length * e * e * (0.5 + e * (shape.p / 6.0 + e * (shape.q / 12.0))),
            kl * e * (1.0 + e * (0.5 * shape.p + e * (shape.q / 3.0))),
            stiffness * (1.0 + e * (shape.p + e * shape.q))};
}

/// g(r) = a r^3 + b r^2 + c r + d, the form of the paper: numbers that cancel to nine digits for
/// small edges, so nothing is computed with them but what scales them apart.
struct CubicCoefficients {
    double a, b, c, d; ///< N/m^3, N/m^2, N/m, N
};
CubicCoefficients cubic_coefficients(const LawShape& shape, double stiffness, double rest_length);

/// A force that holds an edge within stretches [least, greatest], on top of its law: nothing
/// between them, beyond them
///
///     T = force u^2 / (1 - u),   u = (s - greatest) / (0.01 greatest)
///
/// and the like below: convex, with a continuous stiffness, and without bound at 1 % beyond. From
/// u = 0.95 on it goes straight on, so that a step that lands far outside finds its way back. So
/// 18 times `force` stretches an edge by 0.95 %, 38 times by 1 %, whatever its K.
struct StretchLimit {
    double least = 0.0; ///< 0: none
    double greatest = k_forever;
    double force = 0.0; ///< N; 0: no limit at all
};
EdgeResponse limit_response(const StretchLimit& limit, double rest_length, double s);

/// Parameters that all edges of one kind in an object have in common.
struct EdgeLaw {
    LawShape shape;
    double damping = 0.0;          ///< N s/m, see edge_terms
    double jacobian_damping = 1.0; ///< see edge_terms
    StretchLimit limit;
};

/// Least stiffness along an edge that the Jacobian has, as a fraction of K. Smaller: an edge of
/// negative stiffness is carried past its ends in one step; larger: Newton needs more steps there.
inline constexpr double k_least_stiffness = 0.1;

/// While a limit holds, the edge is damped by this time (s) times the limit's stiffness: a step
/// that is linearised once passes the limit before it meets it, and would bounce back.
inline constexpr double k_limit_damping_time = 0.02;

/// Energy, force and the system blocks scales.stiffness * K + scales.damping * D of one edge.
///
/// The energy's second derivative has the eigenvalues g' along the edge and, twice, g / r across.
/// They are made positive where they are not (along: k_least_stiffness; across, which is under
/// compression: 0), so blocks are positive definite, and exact under tension of a monotone law.
///
/// `damping` is a force -damping (v0 - v1) on end 0: as in the paper along the relative velocity,
/// so it slows the turning of an edge as well as its change of length.
///
/// `jacobian_damping` f scales b and d of the law in the Jacobian alone, as the paper does with
/// 0.99. What it does: b and d are large and cancel, so it adds (1 - f) 2 |b| r along the edge and
/// (1 - f) (|b| r + |d| / r) across it: at rest, for K1 = 6 K, K2 = 2 K, a = 1.1, 0.9 and f = 0.99,
/// 5.8 K and 3.8 K. The edge moves as if 6.8 times as stiff in a step and with a stiffness against
/// turning that it has not, which the next step takes back: damping that grows with the time step.
/// Where it comes to rest is not changed.
///
/// Ends that coincide have no direction: the force is zero there, the blocks are bounded.
ElementTerms<2> edge_terms(const std::array<Vec3, 2>& x,
                           const std::array<Vec3, 2>& v,
                           double stiffness,
                           double rest_length,
                           const EdgeLaw& law,
                           SystemScales scales);

/// One edge at work, inlined into the loops over many: see edge_terms.
class EdgeKernel {
public:
    /// @param difference  x0 - x1, m
    EdgeKernel(const EdgeLaw& law, double stiffness, double rest_length, const Vec3& difference)
        : difference_(difference), length_(difference.norm()) {
        const double inverse = 1.0 / rest_length;
        const double e = (length_ - rest_length) * inverse;
        stretch_ = length_ * inverse;
        tension_ =
            stiffness * rest_length * e * (1.0 + e * (0.5 * law.shape.p + e * (law.shape.q / 3.0)));
        along_ = stiffness * (1.0 + e * (law.shape.p + e * law.shape.q));
        if (stretch_ > law.limit.greatest || stretch_ < law.limit.least) {
            limit_ = limit_response(law.limit, rest_length, stretch_);
        }
        shortest_ = k_shortest * rest_length;
    }

    double energy(const EdgeLaw& law, double stiffness, double rest_length) const {
        return edge_response(law.shape, stiffness, rest_length, stretch_).energy + limit_.energy;
    }

    /// Force on end 0, N. @param rate  v0 - v1, m/s
    Vec3 force(const EdgeLaw& law, const Vec3& rate) const {
        const double inverse = 1.0 / std::max(length_, shortest_);
        Vec3 force = (-(tension_ + limit_.tension) * inverse) * difference_ - law.damping * rate;
        if (limit_.stiffness > 0.0) {
            const double approach = difference_.dot(rate) * inverse * inverse;
            force -= (k_limit_damping_time * limit_.stiffness * approach) * difference_;
        }
        return force;
    }

    /// Block (0, 0) of the system; (0, 1) is its negative.
    Mat3
    block(const EdgeLaw& law, double stiffness, double rest_length, SystemScales scales) const {
        const double r = std::max(length_, shortest_);
        const double inverse = 1.0 / r;
        double along = along_;
        double across = (tension_ + limit_.tension) * inverse;
        if (law.jacobian_damping != 1.0) {
            const CubicCoefficients k = cubic_coefficients(law.shape, stiffness, rest_length);
            const double change = law.jacobian_damping - 1.0;
            along += change * 2.0 * k.b * r;
            across += change * (k.b * r + k.d * inverse);
        }
        across = scales.stiffness * std::max(across, 0.0) + scales.damping * law.damping;
        along =
            scales.stiffness * (std::max(along, k_least_stiffness * stiffness) + limit_.stiffness) +
            scales.damping * (law.damping + k_limit_damping_time * limit_.stiffness);
        const Vec3 n = inverse * difference_;
        const Vec3 weighted = (along - across) * n;
        Mat3 block = weighted * n.transpose();
        block.diagonal().array() += across;
        return block;
    }

private:
    /// Fraction of the rest length below which the direction of an edge fades out.
    static constexpr double k_shortest = 1e-6;

    Vec3 difference_;
    double length_, stretch_, tension_, along_, shortest_;
    EdgeResponse limit_;
};

/// The edges of one object, cloth or solid: those that resist stretching, each with the law of the
/// model, then those that resist bending. A bending edge is a Hookean spring in all models and has
/// no limit: cloth may fold. Networks do not change.
class EdgeElements : public ElementLoops<EdgeElements, 2, 1> {
public:
    EdgeElements(const EdgeNetwork& network, Model model, const SpringParams& params);
    explicit EdgeElements(const Cloth& cloth)
        : EdgeElements(cloth.network, cloth.params.model, cloth.params.spring) {}
    explicit EdgeElements(const Solid& solid)
        : EdgeElements(solid.network, solid.params.model, solid.params.spring) {}

    double bending_energy(std::span<const Vec3> x) const; ///< energy of the bending edges alone, J

    double energy_of(std::size_t edge, std::span<const Vec3> x) const {
        return kernel(edge, x).energy(law(edge), stiffness_[edge], rest_lengths_[edge]);
    }
    std::array<Vec3, 2>
    force_of(std::size_t edge, std::span<const Vec3> x, std::span<const Vec3> v) const {
        const Vec3 force = kernel(edge, x).force(law(edge), difference(edge, v));
        return {force, Vec3(-force)};
    }
    ElementTerms<2, 1> terms_of(std::size_t edge,
                                std::span<const Vec3> x,
                                std::span<const Vec3> v,
                                SystemScales scales) const {
        const EdgeKernel at_work = kernel(edge, x);
        const Vec3 force = at_work.force(law(edge), difference(edge, v));
        ElementTerms<2, 1> terms;
        terms.force = {force, Vec3(-force)};
        terms.stiffness[0] =
            at_work.block(law(edge), stiffness_[edge], rest_lengths_[edge], scales);
        return terms;
    }

private:
    const EdgeLaw& law(std::size_t edge) const { return edge < bending_begin_ ? law_ : bend_law_; }
    Vec3 difference(std::size_t edge, std::span<const Vec3> values) const {
        return values[at(nodes_[2 * edge])] - values[at(nodes_[2 * edge + 1])];
    }
    EdgeKernel kernel(std::size_t edge, std::span<const Vec3> x) const {
        return {law(edge), stiffness_[edge], rest_lengths_[edge], difference(edge, x)};
    }

    EdgeLaw law_, bend_law_;
    std::size_t bending_begin_ = 0;                ///< the first bending edge
    std::vector<double> stiffness_, rest_lengths_; ///< N/m, m
};

} // namespace weft
