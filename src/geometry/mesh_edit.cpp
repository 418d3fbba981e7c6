#include "geometry/mesh_edit.h"

#include <algorithm>
#include <cassert>

namespace weft {

VertexStars::VertexStars(std::span<const Triangle> triangles, Index vertex_count)
    : first_(at(vertex_count), k_no_index), next_(3 * triangles.size(), k_no_index) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        add(static_cast<Index>(t), triangles[t]);
    }
}

void VertexStars::add(Index t, const Triangle& corners) {
    const auto vertices = at(std::max({corners[0], corners[1], corners[2]})) + 1;
    if (first_.size() < vertices) {
        first_.resize(vertices, k_no_index);
    }
    if (next_.size() < 3 * (at(t) + 1)) {
        next_.resize(3 * (at(t) + 1), k_no_index);
    }
    for (Index k = 0; k < 3; ++k) {
        Index& first = first_[at(corners[at(k)])];
        next_[at(3 * t + k)] = first;
        first = 3 * t + k;
    }
}

void VertexStars::remove(Index t, const Triangle& corners) {
    for (Index k = 0; k < 3; ++k) {
        Index* link = &first_[at(corners[at(k)])];
        while (*link != 3 * t + k) {
            assert(*link != k_no_index);
            link = &next_[at(*link)];
        }
        *link = next_[at(3 * t + k)];
    }
}

void VertexStars::triangles_of(Index v, std::vector<Index>& star) const {
    star.clear();
    for (Index corner = first_[at(v)]; corner != k_no_index; corner = next_[at(corner)]) {
        star.push_back(corner / 3);
    }
    std::sort(star.begin(), star.end());
}

bool VertexStars::is_empty(Index v) const {
    return first_[at(v)] == k_no_index;
}

namespace {

constexpr Triangle k_dead_triangle{k_no_index, k_no_index, k_no_index};
constexpr MeshEdge k_dead_edge{
    {k_no_index, k_no_index}, {k_no_index, k_no_index}, {k_no_index, k_no_index}};

std::size_t side_of(const MeshEdge& edge, Index t) {
    assert(edge.triangle[0] == t || edge.triangle[1] == t);
    return edge.triangle[0] == t ? 0 : 1;
}

/// Triangles and edges by slot, with what the edits say to them in one word.
struct Mesh {
    EditedMesh m;

    Triangle& triangle(Index t) { return m.triangles[at(t)]; }
    MeshEdge& edge(Index e) { return m.topology.edges[at(e)]; }
    std::array<Index, 3>& edges_of(Index t) { return m.topology.triangle_edges[at(t)]; }

    void set(Index t, const Triangle& corners, const std::array<Index, 3>& edges) {
        triangle(t) = corners;
        edges_of(t) = edges;
    }

    Index add(const Triangle& corners, const std::array<Index, 3>& edges) {
        m.triangles.push_back(corners);
        m.topology.triangle_edges.push_back(edges);
        return static_cast<Index>(m.triangles.size()) - 1;
    }

    Index add(const MeshEdge& edge) {
        m.topology.edges.push_back(edge);
        return static_cast<Index>(m.topology.edges.size()) - 1;
    }

    /// Replaces triangle `from` at edge e by triangle `to` with that apex.
    void set_side(Index e, Index from, Index to, Index apex) {
        const std::size_t side = side_of(edge(e), from);
        edge(e).triangle[side] = to;
        edge(e).apex[side] = apex;
    }

    void kill_triangle(Index t) { set(t, k_dead_triangle, k_dead_triangle); }
    void kill_edge(Index e) { edge(e) = k_dead_edge; }
};

/// An edge (a, b) being cut in three: (a, v1), the middle one (v1, v2), and (v2, b).
struct CutEdge {
    Index first, middle, last;
    Index v1, v2;
};

/// Cuts t = (P, a, b), which lies on that side of the edge.
std::array<Index, 2> trisect_side(Mesh mesh, Index t, std::size_t side, const CutEdge& cut) {
    const auto [first, middle, last, v1, v2] = cut;
    const auto [P, a, b] = mesh.triangle(t);
    const auto [opposite, b_P, P_a] = mesh.edges_of(t);
    assert(opposite == middle);

    const Index to_v1 = mesh.add(MeshEdge{{P, v1}, {t, k_no_index}, {v2, a}});
    const Index to_v2 = mesh.add(MeshEdge{{v2, P}, {t, k_no_index}, {v1, b}});
    const Index at_first = mesh.add(Triangle{v1, P, a}, {P_a, first, to_v1});
    const Index at_last = mesh.add(Triangle{v2, b, P}, {b_P, to_v2, last});
    mesh.edge(to_v1).triangle[1] = at_first;
    mesh.edge(to_v2).triangle[1] = at_last;
    mesh.set(t, {P, v1, v2}, {middle, to_v2, to_v1});
    mesh.set_side(P_a, t, at_first, v1);
    mesh.set_side(b_P, t, at_last, v2);
    mesh.edge(first).triangle[side] = at_first;
    mesh.edge(first).apex[side] = P;
    mesh.edge(last).triangle[side] = at_last;
    mesh.edge(last).apex[side] = P;
    return {at_first, at_last};
}

/// Undoes trisect_side of the middle triangle t = (P, v1, v2), but for the outer edges, which it
/// returns with their outer ends: (a, v1) and (v2, b).
struct OuterEdges {
    Index first, last;
    Index a, b;
};

OuterEdges join_side(Mesh mesh, Index t) {
    const Index P = mesh.triangle(t)[0];
    const auto [e, to_v2, to_v1] = mesh.edges_of(t);
    const Index at_first = triangle_across(mesh.m.topology, t, to_v1);
    const Index at_last = triangle_across(mesh.m.topology, t, to_v2);
    const Index a = mesh.triangle(at_first)[2];
    const Index b = mesh.triangle(at_last)[1];
    assert(mesh.triangle(at_first)[1] == P && mesh.triangle(at_last)[2] == P);
    const Index P_a = mesh.edges_of(at_first)[0];
    const Index b_P = mesh.edges_of(at_last)[0];
    const OuterEdges outer{mesh.edges_of(at_first)[1], mesh.edges_of(at_last)[2], a, b};

    mesh.set(t, {P, a, b}, {e, b_P, P_a});
    mesh.set_side(P_a, at_first, t, b);
    mesh.set_side(b_P, at_last, t, a);
    mesh.kill_triangle(at_first);
    mesh.kill_triangle(at_last);
    mesh.kill_edge(to_v1);
    mesh.kill_edge(to_v2);
    return outer;
}

} // namespace

std::size_t corner_opposite(const EdgeTopology& topology, Index t, Index e) {
    const auto& edges = topology.triangle_edges[at(t)];
    const auto k =
        static_cast<std::size_t>(std::find(edges.begin(), edges.end(), e) - edges.begin());
    assert(k < 3);
    return k;
}

Index triangle_across(const EdgeTopology& topology, Index t, Index e) {
    const MeshEdge& edge = topology.edges[at(e)];
    return edge.triangle[1 - side_of(edge, t)];
}

bool is_dead(const Triangle& triangle) {
    return triangle[0] == k_no_index;
}

bool is_dead(const MeshEdge& edge) {
    return edge.v[0] == k_no_index;
}

std::array<Index, 2> split_triangle(EditedMesh edited, Index t, Index p) {
    Mesh mesh{edited};
    const auto [c0, c1, c2] = mesh.triangle(t);
    const auto [e12, e20, e01] = mesh.edges_of(t);
    const auto next = static_cast<Index>(edited.triangles.size());
    const std::array<Index, 2> added{next, next + 1};

    const Index s0 = mesh.add(MeshEdge{{p, c0}, {t, added[1]}, {c1, c2}});
    const Index s1 = mesh.add(MeshEdge{{p, c1}, {added[0], t}, {c2, c0}});
    const Index s2 = mesh.add(MeshEdge{{p, c2}, {added[1], added[0]}, {c0, c1}});
    mesh.set(t, {p, c0, c1}, {e01, s1, s0});
    mesh.add(Triangle{p, c1, c2}, {e12, s2, s1});
    mesh.add(Triangle{p, c2, c0}, {e20, s0, s2});
    mesh.set_side(e01, t, t, p);
    mesh.set_side(e12, t, added[0], p);
    mesh.set_side(e20, t, added[1], p);
    return added;
}

void merge_triangles(EditedMesh edited, const std::array<Index, 3>& children) {
    Mesh mesh{edited};
    const auto [t, t1, t2] = children;
    const auto [p, c0, c1] = mesh.triangle(t);
    const Index c2 = mesh.triangle(t1)[2];
    assert(mesh.triangle(t1) == (Triangle{p, c1, c2}) &&
           mesh.triangle(t2) == (Triangle{p, c2, c0}));
    const auto [e01, s1, s0] = mesh.edges_of(t);
    const auto [e12, s2, same_s1] = mesh.edges_of(t1);
    const Index e20 = mesh.edges_of(t2)[0];
    assert(same_s1 == s1);

    mesh.set(t, {c0, c1, c2}, {e12, e20, e01});
    mesh.set_side(e01, t, t, c2);
    mesh.set_side(e12, t1, t, c0);
    mesh.set_side(e20, t2, t, c1);
    mesh.kill_triangle(t1);
    mesh.kill_triangle(t2);
    for (const Index spoke : {s0, s1, s2}) {
        mesh.kill_edge(spoke);
    }
}

void flip_edge(EditedMesh edited, Index e) {
    Mesh mesh{edited};
    const MeshEdge edge = mesh.edge(e);
    assert(!edge.is_boundary());
    const auto [A, B] = edge.triangle;
    const auto [a, b] = edge.v;
    const auto [P, Q] = edge.apex;
    assert(mesh.triangle(A) == (Triangle{P, a, b}) && mesh.triangle(B) == (Triangle{Q, b, a}));
    const auto [e_A, b_P, P_a] = mesh.edges_of(A);
    const auto [e_B, a_Q, Q_b] = mesh.edges_of(B);
    assert(e_A == e && e_B == e);

    mesh.edge(e) = {{Q, P}, {A, B}, {a, b}};
    mesh.set(A, {P, a, Q}, {a_Q, e, P_a});
    mesh.set(B, {Q, b, P}, {b_P, e, Q_b});
    mesh.set_side(P_a, A, A, Q);
    mesh.set_side(a_Q, B, A, P);
    mesh.set_side(Q_b, B, B, P);
    mesh.set_side(b_P, A, B, Q);
}

void unflip_edge(EditedMesh edited, Index e) {
    Mesh mesh{edited};
    const MeshEdge edge = mesh.edge(e);
    assert(!edge.is_boundary());
    const auto [A, B] = edge.triangle;
    const auto [Q, P] = edge.v;
    const auto [a, b] = edge.apex;
    assert(mesh.triangle(A) == (Triangle{P, a, Q}) && mesh.triangle(B) == (Triangle{Q, b, P}));
    const auto [a_Q, e_A, P_a] = mesh.edges_of(A);
    const auto [b_P, e_B, Q_b] = mesh.edges_of(B);
    assert(e_A == e && e_B == e);

    mesh.edge(e) = {{a, b}, {A, B}, {P, Q}};
    mesh.set(A, {P, a, b}, {e, b_P, P_a});
    mesh.set(B, {Q, b, a}, {e, a_Q, Q_b});
    mesh.set_side(P_a, A, A, b);
    mesh.set_side(b_P, B, A, a);
    mesh.set_side(Q_b, B, B, a);
    mesh.set_side(a_Q, A, B, b);
}

Trisection trisect_edge(EditedMesh edited, Index e, Index v1, Index v2) {
    Mesh mesh{edited};
    const MeshEdge edge = mesh.edge(e);
    const auto [a, b] = edge.v;
    const MeshEdge open{{a, v1}, {k_no_index, k_no_index}, {k_no_index, k_no_index}};
    const Index first = mesh.add(open);
    const Index last = mesh.add(MeshEdge{{v2, b}, open.triangle, open.apex});

    Trisection result{{k_no_index, k_no_index}, {k_no_index, k_no_index}};
    const auto near = trisect_side(mesh, edge.triangle[0], 0, {first, e, last, v1, v2});
    result.at_first[0] = near[0];
    result.at_last[0] = near[1];
    if (!edge.is_boundary()) { // seen from the other side the edge runs from b to a
        const auto far = trisect_side(mesh, edge.triangle[1], 1, {last, e, first, v2, v1});
        result.at_last[1] = far[0];
        result.at_first[1] = far[1];
    }
    mesh.edge(e).v = {v1, v2};
    return result;
}

void join_edge(EditedMesh edited, Index e) {
    Mesh mesh{edited};
    const MeshEdge edge = mesh.edge(e);
    const OuterEdges near = join_side(mesh, edge.triangle[0]);
    if (!edge.is_boundary()) {
        [[maybe_unused]] const OuterEdges far = join_side(mesh, edge.triangle[1]);
        assert(far.first == near.last && far.last == near.first);
    }
    mesh.edge(e).v = {near.a, near.b};
    mesh.kill_edge(near.first);
    mesh.kill_edge(near.last);
}

void move_triangle(EditedMesh edited, Index from, Index to) {
    Mesh mesh{edited};
    assert(is_dead(mesh.triangle(to)) && !is_dead(mesh.triangle(from)));
    mesh.set(to, mesh.triangle(from), mesh.edges_of(from));
    for (const Index e : mesh.edges_of(to)) {
        mesh.edge(e).triangle[side_of(mesh.edge(e), from)] = to;
    }
    mesh.kill_triangle(from);
}

void move_edge(EditedMesh edited, Index from, Index to) {
    Mesh mesh{edited};
    assert(is_dead(mesh.edge(to)) && !is_dead(mesh.edge(from)));
    for (const Index t : mesh.edge(from).triangle) {
        if (t != k_no_index) {
            mesh.edges_of(t)[corner_opposite(edited.topology, t, from)] = to;
        }
    }
    mesh.edge(to) = mesh.edge(from);
    mesh.kill_edge(from);
}

void rename_vertex(EditedMesh edited, std::span<const Index> star, Index from, Index to) {
    Mesh mesh{edited};
    for (const Index t : star) {
        std::replace(mesh.triangle(t).begin(), mesh.triangle(t).end(), from, to);
        for (const Index e : mesh.edges_of(t)) {
            MeshEdge& edge = mesh.edge(e);
            std::replace(edge.v.begin(), edge.v.end(), from, to);
            std::replace(edge.apex.begin(), edge.apex.end(), from, to);
        }
    }
}

} // namespace weft
