#include "adapt/rest_split.h"
#include "adapt/sqrt3_mesh.h"

#include <algorithm>
#include <cassert>

// What makes the mesh coarser again: the exact inverse, from what the slots and records keep.
//
// Around a vertex v that nothing finer rests on, the triangles with v at corner 0 are in the slots
// of the parts that it was put in with: odd as they were, or flipped, with edge 1 to flip back. The
// other triangles around it are the flips' other halves and, on edges, the middle triangles.

namespace weft {

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
