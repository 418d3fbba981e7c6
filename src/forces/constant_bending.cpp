#include "forces/constant_bending.h"

#include "forces/bending.h"

namespace weft {

namespace {

/// Sorts slots below `count`, each once. Many of them are ticked off and gathered, which is faster.
void sort_once(std::vector<Index>& slots, std::size_t count) {
    constexpr std::size_t k_many = 64; // one in so many
    if (slots.size() < count / k_many) {
        std::sort(slots.begin(), slots.end());
        slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
        return;
    }
    std::vector<char> is_in(count, 0);
    for (const Index slot : slots) {
        is_in[at(slot)] = 1;
    }
    slots.clear();
    for (std::size_t slot = 0; slot < count; ++slot) {
        if (is_in[slot] != 0) {
            slots.push_back(static_cast<Index>(slot));
        }
    }
}

/// Triangles that changed, or one of whose edges or neighbours did; as changed_hinges.
std::vector<Index> changed_patches(const Cloth& cloth, const ClothChanges& changes) {
    // A triangle and its neighbours are all those at its edges.
    std::vector<Index> slots = changes.triangles;
    for (const Index e : changed_hinges(cloth, changes)) {
        for (const Index t : cloth.topology.edges[at(e)].triangle) {
            if (t != k_no_index) {
                slots.push_back(t);
            }
        }
    }
    sort_once(slots, cloth.triangles.size());
    return slots;
}

/// Rest corners of triangle t, turned so that vertex `first` comes first.
RestCorners corners_from(const Cloth& cloth, Index t, Index first) {
    const Triangle& triangle = cloth.triangles[at(t)];
    const RestCorners corners = rest_corners(cloth.rest[at(t)]);
    const auto k = static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), first) -
                                            triangle.begin());
    assert(k < 3);
    return {corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]};
}

/// Stencil of an edge; nothing where there is no second triangle to bend against.
void set_hinge(const Cloth& cloth,
               const MeshEdge& edge,
               std::span<Index> nodes,
               std::span<double> stiffness) {
    if (edge.is_boundary()) {
        std::fill(nodes.begin(), nodes.end(), k_no_index);
        std::fill(stiffness.begin(), stiffness.end(), 0.0);
        return;
    }
    // turned to (apex, v0, v1) and (apex, v1, v0)
    const RestCorners left = corners_from(cloth, edge.triangle[0], edge.apex[0]);
    const RestCorners right = corners_from(cloth, edge.triangle[1], edge.apex[1]);
    const auto jump = edge_jump({rest_cotangent(left, 1), rest_cotangent(right, 2)},
                                {rest_cotangent(left, 2), rest_cotangent(right, 1)});
    const auto q = hinge_bend_stiffness(
        jump, cloth.rest[at(edge.triangle[0])].area + cloth.rest[at(edge.triangle[1])].area,
        cloth.params.fabric.bend_stiffness);
    std::copy(edge.v.begin(), edge.v.end(), nodes.begin());
    std::copy(edge.apex.begin(), edge.apex.end(), nodes.begin() + 2);
    std::copy(q.begin(), q.end(), stiffness.begin());
}

void set_patch(const Cloth& cloth, Index t, std::span<Index> nodes, std::span<double> stiffness) {
    const Triangle& triangle = cloth.triangles[at(t)];
    BendPatch patch{};
    patch.corners = rest_corners(cloth.rest[at(t)]);
    for (std::size_t k = 0; k < 3; ++k) {
        const MeshEdge& edge = cloth.topology.edges[at(cloth.topology.triangle_edges[at(t)][k])];
        const std::size_t other = edge.triangle[0] == t ? 1 : 0;
        patch.has_neighbour[k] = !edge.is_boundary();
        if (patch.has_neighbour[k]) {
            patch.neighbours[k] = corners_from(cloth, edge.triangle[other], edge.apex[other]);
        }
        nodes[k] = triangle[k];
        nodes[3 + k] = patch.has_neighbour[k] ? edge.apex[other] : k_no_index;
    }
    const auto q = mid_edge_bend_stiffness(patch, cloth.params.fabric.bend_stiffness);
    std::copy(q.begin(), q.end(), stiffness.begin());
}

/// Calls f(a, b, Q_ab) for the whole symmetric matrix of one element.
template <typename F> void for_each_entry(int n, std::span<const double> q, const F& f) {
    for (int a = 0; a < n; ++a) {
        for (int b = a; b < n; ++b) {
            const double value = q[block_index(n, a, b)];
            f(at(a), at(b), value);
            if (a != b) {
                f(at(b), at(a), value);
            }
        }
    }
}

int nodes_of(BendModel model) {
    return model == BendModel::Quadratic ? 4 : 6;
}

void set_element_of(const Cloth& cloth,
                    Index slot,
                    std::span<Index> nodes,
                    std::span<double> stiffness) {
    switch (cloth.params.bend_model) {
    case BendModel::Quadratic:
        set_hinge(cloth, cloth.topology.edges[at(slot)], nodes, stiffness);
        break;
    case BendModel::MidEdge:
        set_patch(cloth, slot, nodes, stiffness);
        break;
    }
}

} // namespace

std::vector<Index> changed_hinges(const Cloth& cloth, const ClothChanges& changes) {
    std::vector<Index> slots = changes.edges;
    for (const Index t : changes.triangles) {
        const auto& edges = cloth.topology.triangle_edges[at(t)];
        slots.insert(slots.end(), edges.begin(), edges.end());
    }
    sort_once(slots, cloth.topology.edges.size());
    return slots;
}

std::size_t ConstantBending::slot_count(const Cloth& cloth) {
    return cloth.params.fabric.bend_stiffness <= 0.0         ? 0
           : cloth.params.bend_model == BendModel::Quadratic ? cloth.topology.edges.size()
                                                             : cloth.triangles.size();
}

std::vector<Index> ConstantBending::changed_slots(const Cloth& cloth, const ClothChanges& changes) {
    if (cloth.params.fabric.bend_stiffness <= 0.0) {
        return {};
    }
    return cloth.params.bend_model == BendModel::Quadratic ? changed_hinges(cloth, changes)
                                                           : changed_patches(cloth, changes);
}

BendElement ConstantBending::element(const Cloth& cloth, Index slot) {
    BendElement element;
    if (cloth.params.fabric.bend_stiffness > 0.0) {
        element.count = nodes_of(cloth.params.bend_model);
        set_element_of(cloth, slot, {element.nodes.data(), at(element.count)},
                       {element.stiffness.data(), at(block_count(element.count))});
    }
    return element;
}

Vec3 BendElement::gradient(int a, std::span<const Vec3> x) const {
    Vec3 sum = Vec3::Zero();
    for (int b = 1; b < count; ++b) {
        if (has(b)) {
            sum += q(a, b) * (x[at(node(b))] - x[at(node(0))]); // see ConstantBending::forces
        }
    }
    return sum;
}

double BendElement::energy(std::span<const Vec3> x) const {
    double twice = 0.0;
    for (int a = 1; a < count; ++a) {
        if (has(a)) {
            twice += gradient(a, x).dot(x[at(node(a))] - x[at(node(0))]);
        }
    }
    return 0.5 * twice;
}

ConstantBending::ConstantBending(const Cloth& cloth)
    : nodes_per_element_(nodes_of(cloth.params.bend_model)) {
    assert(cloth.rest.size() == cloth.triangles.size());
    resize(cloth);
    for (std::size_t e = 0; e < size(); ++e) {
        set_element(cloth, static_cast<Index>(e));
    }
}

std::vector<Index> ConstantBending::remesh(const Cloth& cloth, const ClothChanges& changes) {
    resize(cloth);
    std::vector<Index> slots = changed_slots(cloth, changes);
    for (const Index slot : slots) {
        set_element(cloth, slot);
    }
    return slots;
}

void ConstantBending::resize(const Cloth& cloth) {
    const std::size_t elements = slot_count(cloth);
    nodes_.resize(elements * at(nodes_per_element_));
    stiffness_.resize(elements * at(block_count(nodes_per_element_)));
}

void ConstantBending::set_element(const Cloth& cloth, Index slot) {
    const auto count = at(nodes_per_element_);
    const auto entries = at(block_count(nodes_per_element_));
    const std::span<Index> nodes(&nodes_[at(slot) * count], count);
    const std::span<double> stiffness(&stiffness_[at(slot) * entries], entries);
    set_element_of(cloth, slot, nodes, stiffness);
}

void ConstantBending::forces(std::span<const Vec3> x, std::span<Vec3> element_forces) const {
    assert(element_forces.size() == nodes_.size());
    const int n = nodes_per_element_;
    const auto count = at(n);
    const auto entries = at(block_count(n));
    parallel_for(size(), [&](std::size_t e) {
        const Index* nodes = &nodes_[e * count];
        // Relative to the first node: the rows of Q sum to zero, and far from the origin nothing
        // is lost.
        if (nodes[0] == k_no_index) {
            std::fill_n(&element_forces[e * count], count, Vec3::Zero());
            return;
        }
        const Vec3& origin = x[at(nodes[0])];
        std::array<Vec3, 6> relative;
        for (std::size_t a = 0; a < count; ++a) {
            relative[a] = nodes[a] == k_no_index ? Vec3::Zero() : Vec3(x[at(nodes[a])] - origin);
            element_forces[e * count + a] = Vec3::Zero();
        }
        for_each_entry(n, {&stiffness_[e * entries], entries},
                       [&](std::size_t a, std::size_t b, double q) {
                           element_forces[e * count + a] -= q * relative[b];
                       });
    });
}

double ConstantBending::energy(std::span<const Vec3> x) const {
    const int n = nodes_per_element_;
    const auto count = at(n);
    const auto entries = at(block_count(n));
    return parallel_sum(size(), [&](std::size_t e) {
        const Index* nodes = &nodes_[e * count];
        if (nodes[0] == k_no_index) {
            return 0.0;
        }
        const Vec3& origin = x[at(nodes[0])];
        double twice = 0.0;
        for_each_entry(
            n, {&stiffness_[e * entries], entries}, [&](std::size_t a, std::size_t b, double q) {
                if (nodes[a] != k_no_index && nodes[b] != k_no_index) {
                    twice += q * (x[at(nodes[a])] - origin).dot(x[at(nodes[b])] - origin);
                }
            });
        return 0.5 * twice;
    });
}

} // namespace weft
