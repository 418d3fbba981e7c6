#include "adapt/rest_split.h"
#include "adapt/sqrt3_mesh.h"

#include <algorithm>
#include <cassert>

// What makes the mesh finer: cuts, flips, and the order that they need.

namespace weft {

namespace {

constexpr double k_third = 1.0 / 3.0;
const RestTriangle k_no_rest{Mat2::Zero(), 0.0}; ///< beyond a boundary

} // namespace

bool Sqrt3Mesh::can_refine(Index t) const {
    while (is_odd(t)) {
        const Index e = edge_of(t, 0);
        const bool is_last = edge(e).is_boundary() || are_equal_mates(e);
        if (is_last) {
            return !is_cut_in_three(e) || level_of(generation(t) + 3) <= limits_.max_level;
        }
        t = triangle_across(cloth_->topology, t, e);
    }
    const bool is_frozen = generation(t) == 0 && cloth_->refinement.frozen[at(t)] != 0;
    return !is_frozen && level_of(generation(t) + 1) <= limits_.max_level;
}

bool Sqrt3Mesh::has_room_for(std::size_t triangles) const {
    return cloth_->triangles.size() + triangles <= at(limits_.max_triangles);
}

bool Sqrt3Mesh::refine(Index t) {
    assert(!is_dead(corners(t)));
    if (!can_refine(t)) {
        return false;
    }
    const int before = generation(t);
    if (before % 2 == 0) {
        if (!has_room_for(2)) {
            return false;
        }
        split(t);
        return true;
    }
    while (generation(t) == before) { // until t is flipped, with a mate that catches up
        const Index e = edge_of(t, 0);
        if (!edge(e).is_boundary() && !are_equal_mates(e)) {
            if (!refine(triangle_across(cloth_->topology, t, e))) {
                return false;
            }
        } else if (is_cut_in_three(e)) {
            if (!can_refine(t)) { // its mate has only now become equal
                return false;
            }
            if (!has_room_for(edge(e).is_boundary() ? 2 : 4)) {
                return false;
            }
            trisect(e);
        } else if (!try_flip(e)) {
            return false;
        }
    }
    return true;
}

void Sqrt3Mesh::split(Index t) {
    const Triangle abc = corners(t);
    const RestTriangle parent = cloth_->rest[at(t)];
    const int odd = generation(t) + 1;
    const VertexParents place{cloth_->vertex_count, abc, {k_third, k_third, k_third}};
    InsertedVertex record;
    set_parent_rest(record, parent);
    record.generation = odd;
    const Index p = add_vertex(place, record);

    open(t);
    const auto added = split_triangle(mesh(), t, p);
    make_slots();
    const std::array<Index, 3> children{t, added[0], added[1]};
    for (std::uint32_t k = 0; k < 3; ++k) {
        set_part(children[k], odd, k);
        close(children[k], odd, split_rest(parent, k));
    }
    if (hooks_.insert) {
        hooks_.insert(place);
    }
    for (const Index child : children) {
        try_flip(edge_of(child, 0));
    }
}

void Sqrt3Mesh::trisect(Index e) {
    const MeshEdge cut = edge(e);
    const int odd = generation(cut.triangle[0]) + 2;
    const auto [a, b] = cut.v;
    const Index v1 = cloth_->vertex_count;
    const Index v2 = v1 + 1;
    const std::array<VertexParents, 2> places{
        VertexParents{v1, {a, b, k_no_index}, {2 * k_third, k_third, 0.0}},
        VertexParents{v2, {a, b, k_no_index}, {k_third, 2 * k_third, 0.0}}};
    InsertedVertex record;
    record.generation = odd;
    record.insertion = Insertion::EdgeFirst;
    set_parent_rest(record, cloth_->rest[at(cut.triangle[0])]);
    record.partner = v2;
    add_vertex(places[0], record);
    record.insertion = Insertion::EdgeLast;
    set_parent_rest(record, cut.is_boundary() ? k_no_rest : cloth_->rest[at(cut.triangle[1])]);
    record.partner = v1;
    add_vertex(places[1], record);

    for (const Index t : cut.triangle) {
        if (t != k_no_index) {
            open(t);
        }
    }
    const Trisection parts = trisect_edge(mesh(), e, v1, v2);
    make_slots();
    cut_side(cut.triangle[0], parts.at_first[0], parts.at_last[0], odd);
    if (!cut.is_boundary()) { // seen from there v2 comes first
        cut_side(cut.triangle[1], parts.at_last[1], parts.at_first[1], odd);
    }
    for (const Index outer : {edge_of(parts.at_first[0], 1), edge_of(parts.at_last[0], 2)}) {
        cloth_->refinement.locked[at(outer)] = cloth_->refinement.locked[at(e)];
    }
    for (const VertexParents& place : places) {
        if (hooks_.insert) {
            hooks_.insert(place);
        }
    }
    for (const auto& ends : {parts.at_first, parts.at_last}) {
        for (const Index t : ends) {
            if (t != k_no_index) {
                try_flip(edge_of(t, 0));
            }
        }
    }
}

/// One side of a trisection: the middle, which stays odd's parent slot, and the parts beside it.
void Sqrt3Mesh::cut_side(Index middle, Index first, Index last, int odd) {
    const RestTriangle parent = cloth_->rest[at(middle)];
    const std::array<Index, 3> parts{middle, first, last};
    for (std::uint32_t k = 0; k < 3; ++k) {
        set_part(parts[k], odd, k);
        close(parts[k], k == 0 ? odd + 1 : odd, trisect_rest(parent, k));
    }
}

bool Sqrt3Mesh::try_flip(Index e) {
    if (!waits_for_flip(e)) {
        return false;
    }
    const MeshEdge old = edge(e);
    const auto [A, B] = old.triangle;
    const RestFlip flipped = flip_rest(cloth_->rest[at(A)], cloth_->rest[at(B)]);
    if (hooks_.may_flip && !hooks_.may_flip({old.v, old.apex})) {
        cloth_->refinement.pending_flips.push_back(e);
        return false;
    }
    const int even = generation(A) + 1;
    open(A);
    open(B);
    flip_edge(mesh(), e);
    close(A, even, flipped.rest[0]);
    close(B, even, flipped.rest[1]);
    return true;
}

int Sqrt3Mesh::retry_flips() {
    std::vector<Index> waiting;
    waiting.swap(cloth_->refinement.pending_flips);
    int made = 0;
    for (const Index e : waiting) {
        made += !is_dead(edge(e)) && try_flip(e) ? 1 : 0;
    }
    return made;
}

} // namespace weft
