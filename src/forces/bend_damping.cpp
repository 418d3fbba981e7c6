#include "forces/bend_damping.h"

#include "base/parallel.h"
#include "forces/changed_slots.h"
#include "geometry/dihedral.h"
#include "geometry/triangle_mesh.h"

#include <algorithm>
#include <cassert>

namespace weft {

namespace {

/// Share of its rest area at which a triangle counts as collapsed.
constexpr double k_collapsed_share = 0.1;

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
    hinges_.resize(cloth.topology.edges.size());
    nodes_.resize(4 * hinges_.size());
    for (std::size_t e = 0; e < hinges_.size(); ++e) {
        set_hinge(cloth, static_cast<Index>(e));
    }
}

std::vector<Index> BendDampingElements::update(const Cloth& cloth, const ClothChanges& changes) {
    if (stiffness_ <= 0.0) {
        return {};
    }
    hinges_.resize(cloth.topology.edges.size());
    nodes_.resize(4 * hinges_.size());
    std::vector<Index> slots = changed_hinges(cloth, changes);
    for (const Index slot : slots) {
        set_hinge(cloth, slot);
    }
    return slots;
}

void BendDampingElements::set_hinge(const Cloth& cloth, Index slot) {
    const auto e = static_cast<std::size_t>(slot);
    const MeshEdge& edge = cloth.topology.edges[e];
    if (edge.is_boundary()) {
        hinges_[e] = {0.0, 0.0};
        std::fill_n(&nodes_[4 * e], 4, k_no_index);
        return;
    }
    const auto t = static_cast<std::size_t>(edge.triangle[0]);
    const double a0 = cloth.rest[t].area;
    const double a1 = cloth.rest[static_cast<std::size_t>(edge.triangle[1])].area;
    const Triangle& corners = cloth.triangles[t];
    const auto opposite =
        static_cast<int>(std::find(corners.begin(), corners.end(), edge.apex[0]) - corners.begin());
    const double length = rest_edge_length(cloth.rest[t], opposite);
    hinges_[e] = {stiffness_ * length * length / (a0 + a1), k_collapsed_share * std::min(a0, a1)};
    std::copy(edge.v.begin(), edge.v.end(), &nodes_[4 * e]);
    std::copy(edge.apex.begin(), edge.apex.end(), &nodes_[4 * e + 2]);
}

ElementTerms<4> BendDampingElements::terms(std::size_t hinge,
                                           std::span<const Vec3> x,
                                           std::span<const Vec3> v,
                                           SystemScales scales) const {
    if (nodes_[4 * hinge] == k_no_index) {
        ElementTerms<4> none;
        none.force.fill(Vec3::Zero());
        none.stiffness.fill(Mat3::Zero());
        return none;
    }
    std::array<Vec3, 4> positions, velocities;
    for (std::size_t a = 0; a < 4; ++a) {
        const auto vertex = static_cast<std::size_t>(nodes_[4 * hinge + a]);
        positions[a] = x[vertex];
        velocities[a] = v[vertex];
    }
    return hinge_damping_terms(positions, velocities, hinges_[hinge].damping,
                               hinges_[hinge].least_area, scales);
}

void BendDampingElements::forces(std::span<const Vec3> x,
                                 std::span<const Vec3> v,
                                 std::span<Vec3> element_forces) const {
    assert(element_forces.size() == 4 * size());
    parallel_for(size(), [&](std::size_t e) {
        const auto force = terms(e, x, v, {}).force;
        std::copy(force.begin(), force.end(), element_forces.begin() + static_cast<long>(4 * e));
    });
}

void BendDampingElements::evaluate(std::span<const Vec3> x,
                                   std::span<const Vec3> v,
                                   SystemScales scales,
                                   std::span<Vec3> element_forces,
                                   std::span<Mat3> element_blocks) const {
    assert(element_forces.size() == 4 * size() && element_blocks.size() == 10 * size());
    parallel_for(size(), [&](std::size_t e) {
        const ElementTerms<4> result = terms(e, x, v, scales);
        std::copy(result.force.begin(), result.force.end(),
                  element_forces.begin() + static_cast<long>(4 * e));
        std::copy(result.stiffness.begin(), result.stiffness.end(),
                  element_blocks.begin() + static_cast<long>(10 * e));
    });
}

} // namespace weft
