#include "forces/bend_damping.h"

#include "forces/constant_bending.h"
#include "geometry/curvature.h"
#include "geometry/triangle_mesh.h"

#include <algorithm>

namespace weft {

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
