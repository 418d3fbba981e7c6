#include "forces/bending.h"

#include "forces/constant_bending.h"
#include "forces/elements.h"
#include "geometry/curvature.h"
#include "geometry/triangle_mesh.h"

#include <Eigen/LU>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace weft {

namespace {

double doubled_area(const RestCorners& c) {
    const Vec2 a = c[1] - c[0];
    const Vec2 b = c[2] - c[0];
    return std::abs(a.x() * b.y() - a.y() * b.x());
}

using Jumps = Eigen::Matrix<double, 3, 6>;

/// Jumps of the three edges as functions of the six nodes; zero where there is no neighbour.
Jumps patch_jumps(const BendPatch& patch) {
    Jumps jumps = Jumps::Zero();
    for (int k = 0; k < 3; ++k) {
        const auto& neighbour = patch.neighbours[at(k)];
        if (!patch.has_neighbour[at(k)]) {
            continue;
        }
        const int a = (k + 1) % 3;
        const int b = (k + 2) % 3;
        const auto jump =
            edge_jump({rest_cotangent(patch.corners, a), rest_cotangent(neighbour, 2)},
                      {rest_cotangent(patch.corners, b), rest_cotangent(neighbour, 1)});
        jumps(k, a) = jump[0];
        jumps(k, b) = jump[1];
        jumps(k, k) = jump[2];
        jumps(k, 3 + k) = jump[3];
    }
    return jumps;
}

/// Symmetric 2×2 matrix a a^T as a vector whose norm is the matrix's.
Vec3 squared(const Vec2& a) {
    return {a.x() * a.x(), a.y() * a.y(), std::numbers::sqrt2 * a.x() * a.y()};
}

/// M of the mid-edge operator: column e is what the jump of edge e adds to the second derivatives.
/// Negative because a surface that curves up has conormals that sum downwards.
Mat3 mid_edge_weights(const BendPatch& patch, double area) {
    Mat3 weights = Mat3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
        if (patch.has_neighbour[k]) {
            const Vec2 along =
                (patch.corners[(k + 2) % 3] - patch.corners[(k + 1) % 3]).normalized();
            const double weight = 1.0 / (area + 0.5 * doubled_area(patch.neighbours[k]));
            weights.col(static_cast<int>(k)) = -weight * squared({-along.y(), along.x()});
        }
    }
    return weights;
}

/// The far apex across edge k, unfolded into the triangle's plane.
Vec2 unfolded_apex(const BendPatch& patch, std::size_t k) {
    const Vec2& a = patch.corners[(k + 1) % 3];
    const Vec2 edge = patch.corners[(k + 2) % 3] - a;
    const RestCorners& n = patch.neighbours[k]; // (apex, b, a)
    const Vec2 own = n[1] - n[2];
    const double along = (n[0] - n[2]).dot(own) / own.squaredNorm();
    const double across = doubled_area(n) / own.squaredNorm();
    return a + along * edge + across * Vec2(edge.y(), -edge.x()); // counter-clockwise: outside
}

/// Jumps of the three quadratic surfaces with second derivatives (1,0,0), (0,1,0), (0,0,1) in the
/// vectors of `squared`.
Mat3 quadratic_jumps(const BendPatch& patch, const Jumps& jumps) {
    const Vec2 centre = (patch.corners[0] + patch.corners[1] + patch.corners[2]) / 3.0;
    Eigen::Matrix<double, 6, 3> heights;
    for (int k = 0; k < 3; ++k) {
        const auto corner = at(k);
        heights.row(k) = 0.5 * squared(patch.corners[corner] - centre).transpose();
        heights.row(3 + k) = 0.5 * squared(unfolded_apex(patch, corner) - centre).transpose();
    }
    return jumps * heights;
}

/// M: the minimum of |M J - 1|^2 + 2 A^2 weight |M - M_midedge|^2, J the quadratics' jumps.
Mat3 curvature_weights(const BendPatch& patch, const Jumps& jumps, double area) {
    const Mat3 start = mid_edge_weights(patch, area);
    if (!(patch.has_neighbour[0] && patch.has_neighbour[1] && patch.has_neighbour[2])) {
        return start;
    }
    const Mat3 J = quadratic_jumps(patch, jumps);
    const Mat3 normal =
        J * J.transpose() + 2.0 * area * area * k_mid_edge_weight * Mat3::Identity();
    return start + (Mat3::Identity() - start * J) * J.transpose() * normal.inverse();
}

} // namespace

double rest_cotangent(const RestCorners& corners, int k) {
    const Vec2& corner = corners[at(k)];
    const Vec2 a = corners[at((k + 1) % 3)] - corner;
    const Vec2 b = corners[at((k + 2) % 3)] - corner;
    const double area = doubled_area(corners);
    assert(area > 0.0);
    return a.dot(b) / area;
}

std::array<double, 4> edge_jump(const std::array<double, 2>& cot0,
                                const std::array<double, 2>& cot1) {
    return {cot1[0] + cot1[1], cot0[0] + cot0[1], -cot0[0] - cot1[0], -cot0[1] - cot1[1]};
}

std::array<double, 10>
hinge_bend_stiffness(const std::array<double, 4>& jump, double area_sum, double rigidity) {
    assert(area_sum > 0.0);
    std::array<double, 10> q{};
    for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a; b < 4; ++b) {
            q[block_index(4, static_cast<int>(a), static_cast<int>(b))] =
                rigidity / area_sum * jump[a] * jump[b];
        }
    }
    return q;
}

std::array<double, 21> mid_edge_bend_stiffness(const BendPatch& patch, double rigidity) {
    const double area = 0.5 * doubled_area(patch.corners);
    const Jumps jumps = patch_jumps(patch);
    const Eigen::Matrix<double, 3, 6> B = curvature_weights(patch, jumps, area) * jumps;
    std::array<double, 21> q{};
    for (int a = 0; a < 6; ++a) {
        for (int b = a; b < 6; ++b) {
            q[block_index(6, a, b)] = rigidity * area * B.col(a).dot(B.col(b));
        }
    }
    return q;
}

namespace {

/// A triangle below this fraction of its rest area counts as collapsed.
constexpr double k_collapsed_fraction = 0.1;

} // namespace

ElementTerms<4> hinge_damping_terms(const std::array<Vec3, 4>& x,
                                    const std::array<Vec3, 4>& v,
                                    double damping,
                                    double least_area,
                                    SystemScales scales) {
    auto gradient = dihedral_gradient(x[0], x[1], x[2], x[3]);
    const double area = std::min(triangle_area(x[0], x[1], x[2]), triangle_area(x[1], x[0], x[3]));
    if (area < least_area) {
        for (Vec3& g : gradient) {
            g *= area / least_area; // all four alike: no force or torque appears
        }
    }
    double rate = 0.0;
    for (std::size_t a = 0; a < 4; ++a) {
        rate += gradient[a].dot(v[a] - v[0]);
    }
    ElementTerms<4> terms;
    for (std::size_t a = 0; a < 4; ++a) {
        terms.force[a] = -damping * rate * gradient[a];
        for (std::size_t b = a; b < 4; ++b) {
            terms.stiffness[block_index(4, static_cast<int>(a), static_cast<int>(b))] =
                scales.damping * damping * gradient[a] * gradient[b].transpose();
        }
    }
    return terms;
}

BendDampingElements::BendDampingElements(const Cloth& cloth)
    : stiffness_(cloth.params.fabric.damping(1) * cloth.params.fabric.bend_stiffness) {
    if (stiffness_ <= 0.0) {
        return;
    }
    resize(cloth);
    for (std::size_t e = 0; e < hinges_.size(); ++e) {
        set_hinge(cloth, static_cast<Index>(e));
    }
}

std::vector<Index> BendDampingElements::remesh(const Cloth& cloth, const ClothChanges& changes) {
    if (stiffness_ <= 0.0) {
        return {};
    }
    resize(cloth);
    std::vector<Index> slots = changed_hinges(cloth, changes);
    for (const Index slot : slots) {
        set_hinge(cloth, slot);
    }
    return slots;
}

void BendDampingElements::resize(const Cloth& cloth) {
    hinges_.resize(cloth.topology.edges.size());
    nodes_.resize(4 * hinges_.size());
}

void BendDampingElements::set_hinge(const Cloth& cloth, Index edge_index) {
    const std::size_t e = at(edge_index);
    const MeshEdge& edge = cloth.topology.edges[e];
    if (edge.is_boundary()) {
        hinges_[e] = {0.0, 0.0};
        std::fill_n(&nodes_[4 * e], 4, k_no_index);
        return;
    }
    const RestTriangle& rest = cloth.rest[at(edge.triangle[0])];
    const double a0 = rest.area;
    const double a1 = cloth.rest[at(edge.triangle[1])].area;
    const Triangle& corners = cloth.triangles[at(edge.triangle[0])];
    const auto opposite =
        static_cast<int>(std::find(corners.begin(), corners.end(), edge.apex[0]) - corners.begin());
    const double length = rest_edge_length(rest, opposite);
    hinges_[e] = {stiffness_ * length * length / (a0 + a1),
                  k_collapsed_fraction * std::min(a0, a1)};
    std::copy(edge.v.begin(), edge.v.end(), &nodes_[4 * e]);
    std::copy(edge.apex.begin(), edge.apex.end(), &nodes_[4 * e + 2]);
}

ElementTerms<4> BendDampingElements::terms_of(std::size_t hinge,
                                              std::span<const Vec3> x,
                                              std::span<const Vec3> v,
                                              SystemScales scales) const {
    if (nodes_[4 * hinge] == k_no_index) {
        ElementTerms<4> none;
        none.force.fill(Vec3::Zero());
        none.stiffness.fill(Mat3::Zero());
        return none;
    }
    return hinge_damping_terms(gather(hinge, x), gather(hinge, v), hinges_[hinge].damping,
                               hinges_[hinge].least_area, scales);
}

} // namespace weft
