#include "adapt/rest_split.h"
#include "adapt/sqrt3_mesh.h"

#include <algorithm>
#include <cassert>

// Edits of the sqrt(3) mesh: first those that refine it (cuts, flips, and the order that they
// need), then those that coarsen it.
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

// Coarsening is the exact inverse of refining; slots and records keep what it needs.
//
// Around a vertex v that nothing finer rests on, the triangles with v at corner 0 are in the slots
// of the parts that it was put in with: odd as they were, or flipped, with edge 1 to flip back. The
// other triangles around it are the flips' other halves and, on edges, the middle triangles.

bool Sqrt3Mesh::can_remove(Index v) const {
    const Refinement& refinement = cloth_->refinement;
    if (v >= cloth_->vertex_count || !refinement.is_inserted(v) || stars_.is_empty(v)) {
        return false;
    }
    const InsertedVertex& record = refinement.inserted(v);
    const auto is_bare = [&](Index vertex) {
        stars_.triangles_of(vertex, star_);
        return std::all_of(star_.begin(), star_.end(), [&](Index t) {
            return generation(t) == record.generation + 1 ||
                   (generation(t) == record.generation && corners(t)[0] == vertex);
        });
    };
    return is_bare(v) && (record.partner == k_no_index || is_bare(record.partner));
}

bool Sqrt3Mesh::remove(Index v) {
    assert(can_remove(v));
    const InsertedVertex record = cloth_->refinement.inserted(v);
    const bool is_centre = record.insertion == Insertion::Centre;
    const Index first = record.insertion == Insertion::EdgeLast ? record.partner : v;
    const Removal removal = is_centre ? removal_of_centre(v) : removal_of_pair(first);
    if (hooks_.may_remove && !hooks_.may_remove(removal)) {
        return false;
    }
    for (const VertexParents& place : removal.vertices) {
        if (hooks_.remove) {
            hooks_.remove(place);
        }
    }
    for (const VertexParents& place : removal.vertices) {
        unflip_star(place.vertex);
    }
    is_centre ? merge(v) : join(first);
    for (const VertexParents& place : removal.vertices) {
        assert(stars_.is_empty(place.vertex));
        dead_vertices_.push_back(place.vertex);
    }
    return true;
}

/// The slot of a part that was cut with v, nothing finer resting on v; k_no_index: none.
Index Sqrt3Mesh::slot_of_part(Index v, std::uint32_t wanted) const {
    stars_.triangles_of(v, star_);
    const int odd = cloth_->refinement.inserted(v).generation;
    const auto found = std::find_if(star_.begin(), star_.end(), [&](Index t) {
        return corners(t)[0] == v && part(t, odd) == wanted;
    });
    return found == star_.end() ? k_no_index : *found;
}

void Sqrt3Mesh::add_flips_back(Index v, Removal& removal) const {
    stars_.triangles_of(v, star_);
    for (const Index t : star_) {
        if (corners(t)[0] == v && !is_odd(t)) {
            const MeshEdge& flipped = edge(edge_of(t, 1));
            removal.flips.push_back({flipped.v, flipped.apex});
        }
    }
}

Removal Sqrt3Mesh::removal_of_centre(Index v) const {
    Triangle abc; // corner 1 of a part stays through its flip
    for (std::uint32_t k = 0; k < 3; ++k) {
        abc[k] = corners(slot_of_part(v, k))[1];
    }
    Removal removal{{}, {{v, abc, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}}}, {abc}};
    add_flips_back(v, removal);
    return removal;
}

Removal Sqrt3Mesh::removal_of_pair(Index first) const {
    const Index last = cloth_->refinement.inserted(first).partner;
    const Index near = slot_of_part(first, 1); // (v1, P, a), or flipped (v1, P, .)
    const Index P = corners(near)[1];
    const Index b = corners(slot_of_part(last, 2))[1];
    // Flipped, a is corner 1 of the other half.
    const Index a = is_odd(near)
                        ? corners(near)[2]
                        : corners(triangle_across(cloth_->topology, near, edge_of(near, 1)))[1];
    Removal removal{{},
                    {{first, {a, b, k_no_index}, {2.0 / 3.0, 1.0 / 3.0, 0.0}},
                     {last, {a, b, k_no_index}, {1.0 / 3.0, 2.0 / 3.0, 0.0}}},
                    {{P, a, b}}};
    const Index far = slot_of_part(last, 1); // beyond a lock: (v2, Q, b)
    if (far != k_no_index) {
        removal.merged.push_back({corners(far)[1], b, a});
    }
    add_flips_back(first, removal);
    add_flips_back(last, removal);
    return removal;
}

void Sqrt3Mesh::unflip_star(Index v) {
    std::vector<Index> star;
    stars_.triangles_of(v, star);
    for (const Index t : star) {
        if (corners(t)[0] == v && !is_odd(t)) {
            unflip(edge_of(t, 1));
        }
    }
}

void Sqrt3Mesh::unflip(Index e) {
    const auto [A, B] = edge(e).triangle;
    const int odd = generation(A) - 1;
    open(A);
    open(B);
    unflip_edge(mesh(), e);
    close(A, odd, odd_rest(A, odd));
    close(B, odd, odd_rest(B, odd));
}

/// Takes out the vertex of three odd triangles.
void Sqrt3Mesh::merge(Index v) {
    const InsertedVertex& record = cloth_->refinement.inserted(v);
    std::array<Index, 3> children;
    for (std::uint32_t k = 0; k < 3; ++k) {
        children[k] = slot_of_part(v, k);
    }
    const auto [t, second, third] = children;
    for (const Index spoke : {edge_of(t, 2), edge_of(t, 1), edge_of(second, 1)}) {
        dead_edges_.push_back(spoke);
    }
    for (const Index child : children) {
        open(child);
    }
    merge_triangles(mesh(), children);
    dead_triangles_.insert(dead_triangles_.end(), {second, third});
    close(t, record.generation - 1, parent_rest(record));
}

/// Takes out a pair with its outer triangles flipped back.
void Sqrt3Mesh::join(Index first) {
    const EdgeTopology& topology = cloth_->topology;
    const Refinement& refinement = cloth_->refinement;
    const int odd = refinement.inserted(first).generation;
    const Index near = slot_of_part(first, 1);
    const Index e = edge_of(triangle_across(topology, near, edge_of(near, 2)), 0);
    const std::array<Index, 2> middles = edge(e).triangle;

    for (const Index middle : middles) {
        if (middle == k_no_index) {
            continue;
        }
        const Index at_first = triangle_across(topology, middle, edge_of(middle, 2));
        const Index at_last = triangle_across(topology, middle, edge_of(middle, 1));
        if (middle == middles[0]) {
            dead_edges_.insert(dead_edges_.end(), {edge_of(at_first, 1), edge_of(at_last, 2)});
        }
        dead_edges_.insert(dead_edges_.end(), {edge_of(middle, 1), edge_of(middle, 2)});
        dead_triangles_.insert(dead_triangles_.end(), {at_first, at_last});
        for (const Index t : {middle, at_first, at_last}) {
            open(t);
        }
    }
    join_edge(mesh(), e);
    const Index last = refinement.inserted(first).partner;
    for (std::size_t side = 0; side < 2; ++side) {
        if (middles[side] != k_no_index) {
            close(middles[side], odd - 2,
                  parent_rest(refinement.inserted(side == 0 ? first : last)));
        }
    }
}

} // namespace weft
