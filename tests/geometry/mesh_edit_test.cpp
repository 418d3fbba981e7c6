#include "geometry/mesh_edit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>

namespace weft {

TEST(VertexStars, AreThoseOfTheTrianglesEnteredAndNotTakenOut) {
    std::mt19937 random(4);
    constexpr Index k_vertices = 12;
    std::vector<Triangle> triangles;
    for (int t = 0; t < 60; ++t) {
        const auto a = static_cast<Index>(random() % k_vertices);
        triangles.push_back({a, (a + 1 + static_cast<Index>(random() % 5)) % k_vertices,
                             (a + 6 + static_cast<Index>(random() % 6)) % k_vertices});
    }
    VertexStars stars({triangles.data(), 30}, k_vertices);
    for (Index t = 30; t < 60; ++t) {
        stars.add(t, triangles[at(t)]);
    }
    std::vector<char> is_in(60, 1);
    for (Index t = 0; t < 60; t += 1 + static_cast<Index>(random() % 3)) {
        stars.remove(t, triangles[at(t)]);
        is_in[at(t)] = 0;
    }

    for (Index v = 0; v < k_vertices; ++v) {
        std::vector<Index> expected, star;
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            if (is_in[t] && std::count(triangles[t].begin(), triangles[t].end(), v) > 0) {
                expected.push_back(static_cast<Index>(t));
            }
        }
        stars.triangles_of(v, star);
        EXPECT_EQ(star, expected) << "vertex " << v;
        EXPECT_EQ(stars.is_empty(v), expected.empty());
    }
}

namespace {

/// A mesh that edits go over, with a way back for each.
struct EditHistory {
    std::vector<Triangle> triangles;
    EdgeTopology topology;
    Index vertices = 0;
    std::mt19937 random;

    EditedMesh mesh() { return {triangles, topology}; }
    Index any(std::size_t count) {
        return static_cast<Index>(random() % static_cast<unsigned>(count));
    }
};

/// A strip of `cells` squares, each cut along one diagonal, or a ring of them.
std::vector<Triangle> strip(Index cells, bool is_ring) {
    std::vector<Triangle> triangles;
    const Index columns = is_ring ? cells : cells + 1;
    for (Index i = 0; i < cells; ++i) {
        const Index next = (i + 1) % columns;
        triangles.push_back({i, next, columns + i});
        triangles.push_back({next, columns + next, columns + i});
    }
    return triangles;
}

EditHistory history_on(const std::vector<Triangle>& triangles, unsigned seed) {
    EditHistory history{triangles, build_edges(triangles), 0, std::mt19937(seed)};
    for (const Triangle& t : triangles) {
        history.vertices = std::max({history.vertices, t[0] + 1, t[1] + 1, t[2] + 1});
    }
    return history;
}

bool lies_opposite_to_corner_0(const EdgeTopology& topology, Index e) {
    const auto& sides = topology.edges[at(e)].triangle;
    return std::all_of(sides.begin(), sides.end(), [&](Index t) {
        return t == k_no_index || corner_opposite(topology, t, e) == 0;
    });
}

bool joins(const EditHistory& history, Index a, Index b) {
    return std::any_of(history.topology.edges.begin(), history.topology.edges.end(),
                       [&](const MeshEdge& edge) {
                           return edge.v == std::array{a, b} || edge.v == std::array{b, a};
                       });
}

/// An edge with its ends and sides turned so that equal edges compare equal.
using EdgeKey = std::array<Index, 6>;

EdgeKey key_of(MeshEdge edge) {
    if (!edge.is_boundary() && edge.v[0] > edge.v[1]) {
        std::swap(edge.v[0], edge.v[1]);
        std::swap(edge.triangle[0], edge.triangle[1]);
        std::swap(edge.apex[0], edge.apex[1]);
    }
    return {edge.v[0], edge.v[1], edge.triangle[0], edge.triangle[1], edge.apex[0], edge.apex[1]};
}

/// The edges are those that build_edges finds, and each triangle knows its own.
void expect_right_edges(const EditHistory& history) {
    const EdgeTopology built = build_edges(history.triangles);
    std::multiset<EdgeKey> expected, found;
    std::transform(built.edges.begin(), built.edges.end(), std::inserter(expected, expected.end()),
                   key_of);
    std::transform(history.topology.edges.begin(), history.topology.edges.end(),
                   std::inserter(found, found.end()), key_of);
    ASSERT_EQ(found, expected);
    ASSERT_EQ(history.topology.triangle_edges.size(), history.triangles.size());
    for (std::size_t t = 0; t < history.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_EQ(key_of(history.topology.edges[at(history.topology.triangle_edges[t][k])]),
                      key_of(built.edges[at(built.triangle_edges[t][k])]));
        }
    }
}

bool operator==(const MeshEdge& a, const MeshEdge& b) {
    return a.v == b.v && a.triangle == b.triangle && a.apex == b.apex;
}

void expect_same(const EditHistory& a, const EditHistory& b) {
    ASSERT_EQ(a.triangles, b.triangles);
    ASSERT_EQ(a.topology.triangle_edges, b.topology.triangle_edges);
    ASSERT_EQ(a.topology.edges.size(), b.topology.edges.size());
    for (std::size_t e = 0; e < a.topology.edges.size(); ++e) {
        ASSERT_TRUE(a.topology.edges[e] == b.topology.edges[e]) << "edge " << e;
    }
}

/// Drops the dead slots that an inverse leaves at the end.
void trim(EditHistory& history) {
    while (is_dead(history.triangles.back())) {
        history.triangles.pop_back();
        history.topology.triangle_edges.pop_back();
    }
    while (is_dead(history.topology.edges.back())) {
        history.topology.edges.pop_back();
    }
}

using Undo = std::function<void(EditHistory&)>;

/// Makes one edit at random and returns how to take it back; empty when it fell on no place for it.
Undo random_edit(EditHistory& history) {
    const Index e = history.any(history.topology.edges.size());
    const MeshEdge edge = history.topology.edges[at(e)];
    switch (history.any(3)) {
    case 0: {
        const Index t = history.any(history.triangles.size());
        const auto added = split_triangle(history.mesh(), t, history.vertices++);
        return [=](EditHistory& h) {
            merge_triangles(h.mesh(), {t, added[0], added[1]});
            --h.vertices;
        };
    }
    case 1:
        if (edge.is_boundary() || !lies_opposite_to_corner_0(history.topology, e) ||
            joins(history, edge.apex[0], edge.apex[1])) {
            return {};
        }
        flip_edge(history.mesh(), e);
        return [=](EditHistory& h) { unflip_edge(h.mesh(), e); };
    default:
        if (!lies_opposite_to_corner_0(history.topology, e)) {
            return {};
        }
        trisect_edge(history.mesh(), e, history.vertices, history.vertices + 1);
        history.vertices += 2;
        return [=](EditHistory& h) {
            join_edge(h.mesh(), e);
            h.vertices -= 2;
        };
    }
}

} // namespace

TEST(MeshEdit, EdgesStayThoseOfTheTrianglesAfterAnyEdits) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        EditHistory history = history_on(strip(3, seed % 2 == 1), seed);
        for (int edit = 0; edit < 25; ++edit) {
            random_edit(history);
        }
        expect_right_edges(history);
    }
}

TEST(MeshEdit, InversesInReverseOrderGiveBackEverySlot) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        EditHistory history = history_on(strip(4, seed % 2 == 0), seed);
        const EditHistory start = history;
        std::vector<Undo> undos;
        for (int edit = 0; edit < 60; ++edit) {
            if (const Undo undo = random_edit(history)) {
                undos.push_back(undo);
            }
        }
        ASSERT_GT(undos.size(), 5u);
        for (; !undos.empty(); undos.pop_back()) {
            undos.back()(history);
            trim(history);
        }
        expect_same(history, start);
    }
}

TEST(MeshEdit, FlipJoinsTheApexesAndKeepsTheWinding) {
    EditHistory history = history_on({{2, 0, 1}, {3, 1, 0}}, 0);
    const Index e = history.topology.triangle_edges[0][0];

    flip_edge(history.mesh(), e);

    EXPECT_EQ(history.triangles, (std::vector<Triangle>{{2, 0, 3}, {3, 1, 2}}));
    EXPECT_EQ(history.topology.edges[at(e)].v, (std::array<Index, 2>{3, 2}));
}

TEST(MeshEdit, TrisectionCutsBothSidesInThree) {
    EditHistory history = history_on({{2, 0, 1}, {3, 1, 0}}, 0);

    const Trisection cut =
        trisect_edge(history.mesh(), history.topology.triangle_edges[0][0], 4, 5);

    EXPECT_EQ(history.triangles[0], (Triangle{2, 4, 5}));
    EXPECT_EQ(history.triangles[1], (Triangle{3, 5, 4}));
    EXPECT_EQ(history.triangles[at(cut.at_first[0])], (Triangle{4, 2, 0}));
    EXPECT_EQ(history.triangles[at(cut.at_last[0])], (Triangle{5, 1, 2}));
    EXPECT_EQ(history.triangles[at(cut.at_first[1])], (Triangle{4, 0, 3}));
    EXPECT_EQ(history.triangles[at(cut.at_last[1])], (Triangle{5, 3, 1}));
    expect_right_edges(history);
}

TEST(MeshEdit, SlotsMoveAndVerticesChangeTheirNames) {
    EditHistory history = history_on(strip(3, false), 3);
    for (int edit = 0; edit < 12; ++edit) {
        random_edit(history);
    }
    // Room is made in front: the last triangle and the last edge become dead slots to fill.
    const Index last_triangle = static_cast<Index>(history.triangles.size()) - 1;
    history.triangles.push_back({k_no_index, k_no_index, k_no_index});
    history.topology.triangle_edges.push_back({k_no_index, k_no_index, k_no_index});
    move_triangle(history.mesh(), last_triangle, last_triangle + 1);
    move_triangle(history.mesh(), last_triangle + 1, last_triangle);
    trim(history);
    const Index last_edge = static_cast<Index>(history.topology.edges.size()) - 1;
    history.topology.edges.push_back(MeshEdge{{-1, -1}, {-1, -1}, {-1, -1}});
    move_edge(history.mesh(), last_edge, last_edge + 1);
    move_edge(history.mesh(), 0, last_edge);
    move_edge(history.mesh(), last_edge + 1, 0);
    trim(history);
    const Index renamed = history.any(at(history.vertices));
    std::vector<Index> star;
    for (std::size_t t = 0; t < history.triangles.size(); ++t) {
        const Triangle& corners = history.triangles[t];
        if (std::find(corners.begin(), corners.end(), renamed) != corners.end()) {
            star.push_back(static_cast<Index>(t));
        }
    }

    rename_vertex(history.mesh(), star, renamed, history.vertices);

    expect_right_edges(history);
}

} // namespace weft
