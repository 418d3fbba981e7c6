#include "remesh/vertex_energy.h"

#include <algorithm>
#include <type_traits>

namespace weft {

namespace {

/// Derivative of the shape function of a corner on the rest plane, 1/m.
Vec2 shape_gradient(const RestTriangle& rest, std::size_t corner) {
    const Vec2 first = rest.inverse_edges.row(0);
    const Vec2 second = rest.inverse_edges.row(1);
    return corner == 1 ? first : corner == 2 ? second : Vec2(-first - second);
}

/// Second derivative by one corner, of the unstrained triangle and of its tension.
Mat3 corner_stiffness(const PolarFactor& polar,
                      const Vec2& g,
                      double area,
                      const MembraneStiffness& c) {
    const MembraneStress s = membrane_stress(polar, c);
    const double tension = g[0] * (s.s11 * g[0] + 2.0 * s.s12 * g[1]) + g[1] * s.s22 * g[1];
    const double along = c.c11 * g[0] * g[0] + c.c33 * g[1] * g[1];
    const double across = c.c22 * g[1] * g[1] + c.c33 * g[0] * g[0];
    const double both = (c.c12 + c.c33) * g[0] * g[1];
    const Vec3 weft = polar.R.col(0);
    const Vec3 warp = polar.R.col(1);
    return area * (along * weft * weft.transpose() + across * warp * warp.transpose() +
                   both * (weft * warp.transpose() + warp * weft.transpose()) +
                   std::max(0.0, tension) * polar.normal * polar.normal.transpose());
}

} // namespace

const BendElement& BendElements::of(Index slot) {
    std::size_t& place = places_[at(slot)];
    if (place == 0) {
        made_.push_back(ConstantBending::element(cloth_, slot));
        place = made_.size();
    }
    return made_[place - 1];
}

VertexEnergy::VertexEnergy(const Cloth& cloth,
                           const VertexStars& stars,
                           Index v,
                           BendElements& bends)
    : cloth_(cloth), stiffness_(membrane_stiffness(cloth.params.fabric)), vertex_(v) {
    stars.triangles_of(v, star_);
    for_each_energy(cloth, [&](auto kind) {
        using Elements = typename decltype(kind)::type;
        if constexpr (std::is_same_v<Elements, ConstantBending>) {
            if (Elements::slot_count(cloth) > 0) {
                add_bends(bends);
            }
        } else { // the membrane is taken from the star
            static_assert(std::is_same_v<Elements, MembraneElements> || !Adaptive<Elements>);
        }
    });
}

/// Adds the bending elements of all edges, or of all triangles and their neighbours, around it.
void VertexEnergy::add_bends(BendElements& bends) {
    std::vector<Index> slots;
    for (const Index t : star_) {
        for (const Index e : cloth_.topology.triangle_edges[at(t)]) {
            const MeshEdge& edge = cloth_.topology.edges[at(e)];
            if (cloth_.params.bend_model == BendModel::Quadratic) {
                slots.push_back(e);
            } else {
                slots.insert(slots.end(), edge.triangle.begin(), edge.triangle.end());
            }
        }
    }
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
    for (const Index slot : slots) {
        if (slot != k_no_index) {
            add_bend(bends.of(slot));
        }
    }
}

/// A vertex may stand in two places of a stencil: across from two sides of a triangle that has a
/// vertex of three triangles.
void VertexEnergy::add_bend(const BendElement& bend) {
    if (bend.empty()) {
        return;
    }
    for (int a = 0; a < bend.count; ++a) {
        for (int b = 0; b < bend.count && bend.node(a) == vertex_; ++b) {
            if (bend.has(b)) {
                add_coupling(bend.node(b), bend.q(a, b));
            }
        }
    }
}

void VertexEnergy::add_coupling(Index other, double q) {
    if (other == vertex_) {
        own_q_ += q;
        return;
    }
    const auto known = std::find_if(coupled_.begin(), coupled_.end(),
                                    [&](const Coupled& c) { return c.vertex == other; });
    if (known == coupled_.end()) {
        coupled_.push_back({other, q});
    } else {
        known->q += q;
    }
}

Corners VertexEnergy::corners(Index t, std::span<const Vec3> x) const {
    const Triangle& v = cloth_.triangles[at(t)];
    return {x[at(v[0])], x[at(v[1])], x[at(v[2])]};
}

double VertexEnergy::membrane(std::span<const Vec3> x) const {
    double sum = 0.0;
    for (const Index t : star_) {
        sum += membrane_energy(corners(t, x), cloth_.rest[at(t)], stiffness_);
    }
    return sum;
}

/// The row of the vertex sums to zero.
Vec3 VertexEnergy::bending_gradient(std::span<const Vec3> x) const {
    Vec3 sum = Vec3::Zero();
    for (const Coupled& other : coupled_) {
        sum += other.q * (x[at(other.vertex)] - x[at(vertex_)]);
    }
    return sum;
}

double VertexEnergy::bending_change(std::span<const Vec3> x, const Vec3& shift) const {
    return shift.dot(bending_gradient(x)) + 0.5 * own_q_ * shift.squaredNorm();
}

Vec3 VertexEnergy::force(std::span<const Vec3> x, Mat3* stiffness) const {
    Vec3 force = -bending_gradient(x);
    if (stiffness != nullptr) {
        *stiffness = own_q_ * Mat3::Identity();
    }
    for (const Index t : star_) {
        const Triangle& v = cloth_.triangles[at(t)];
        const auto k = static_cast<std::size_t>(std::find(v.begin(), v.end(), vertex_) - v.begin());
        const RestTriangle& rest = cloth_.rest[at(t)];
        const PolarFactor polar = polar_decompose(deformation_gradient(corners(t, x), rest));
        const Vec2 g = shape_gradient(rest, k);
        force -= rest.area *
                 (polar.R * (local_piola_stress(polar, membrane_stress(polar, stiffness_)) * g));
        if (stiffness != nullptr) {
            *stiffness += corner_stiffness(polar, g, rest.area, stiffness_);
        }
    }
    return force;
}

} // namespace weft
