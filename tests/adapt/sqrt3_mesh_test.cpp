#include "adapt/sqrt3_mesh.h"
#include "support/adaptive_cloths.h"
#include "support/mesh_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {

namespace {

using test::MeshHistory;

void expect_same(const Cloth& a, const Cloth& b) {
    ASSERT_EQ(a.vertex_count, b.vertex_count);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.topology.triangle_edges, b.topology.triangle_edges);
    EXPECT_EQ(a.rest_areas, b.rest_areas);
    EXPECT_EQ(a.material_positions, b.material_positions);
    EXPECT_EQ(a.refinement.locked, b.refinement.locked);
    EXPECT_TRUE(a.refinement.vertices.empty());
    EXPECT_TRUE(a.refinement.pending_flips.empty());
    ASSERT_EQ(a.topology.edges.size(), b.topology.edges.size());
    for (std::size_t e = 0; e < a.topology.edges.size(); ++e) {
        const MeshEdge& edge = a.topology.edges[e];
        const MeshEdge& other = b.topology.edges[e];
        EXPECT_TRUE(edge.v == other.v && edge.triangle == other.triangle &&
                    edge.apex == other.apex);
    }
    ASSERT_EQ(a.rest.size(), b.rest.size());
    for (std::size_t t = 0; t < a.rest.size(); ++t) {
        EXPECT_EQ(a.rest[t].inverse_edges, b.rest[t].inverse_edges);
        EXPECT_EQ(a.rest[t].area, b.rest[t].area);
        EXPECT_EQ(a.refinement.triangles[t].generation, 0);
        EXPECT_EQ(a.refinement.triangles[t].parts, 0u);
    }
}

std::array<std::size_t, 3> counts(const Cloth& cloth) {
    return {at(cloth.vertex_count), cloth.topology.edges.size(), cloth.triangles.size()};
}

/// Least and greatest angle of all rest triangles, degrees.
std::array<double, 2> angle_range(const Cloth& cloth) {
    std::array<double, 2> range{180.0, 0.0};
    for (const RestTriangle& rest : cloth.rest) {
        const auto m = rest_corners(rest);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 a = m[(k + 1) % 3] - m[k];
            const Vec2 b = m[(k + 2) % 3] - m[k];
            const double angle =
                std::acos(a.dot(b) / (a.norm() * b.norm())) * 180.0 / std::numbers::pi;
            range = {std::min(range[0], angle), std::max(range[1], angle)};
        }
    }
    return range;
}

std::size_t greatest_valence(const Cloth& cloth) {
    std::vector<std::size_t> valence(at(cloth.vertex_count), 0);
    for (const MeshEdge& edge : cloth.topology.edges) {
        ++valence[at(edge.v[0])];
        ++valence[at(edge.v[1])];
    }
    return *std::max_element(valence.begin(), valence.end());
}

Sheet single_triangle() {
    return {{Vec2(0, 0), Vec2(1, 0), Vec2(0.5, std::sqrt(0.75))}, {{0, 1, 2}}};
}

} // namespace

TEST(Sqrt3Mesh, UniformStepsOfATriangleTripleIt) {
    MeshHistory history(test::adaptive_sheet(single_triangle()), 0);
    const std::vector<std::array<std::size_t, 3>> expected{
        {3, 3, 1}, {4, 6, 3}, {10, 18, 9}, {19, 45, 27}, {55, 135, 81}};

    for (const auto& step : expected) {
        EXPECT_EQ(counts(history.cloth), step);
        history.refine_all();
    }
}

TEST(Sqrt3Mesh, UniformStepsOfAGridTripleIt) {
    MeshHistory history(test::adaptive_sheet(equilateral_sheet(3, 3, 0.1)), 0);
    const std::vector<std::array<std::size_t, 3>> expected{
        {16, 33, 18}, {34, 87, 54}, {100, 261, 162}, {262, 747, 486}, {784, 2241, 1458}};

    for (const auto& step : expected) {
        EXPECT_EQ(counts(history.cloth), step);
        history.refine_all();
    }
}

TEST(Sqrt3Mesh, RandomHistoriesKeepEveryInvariantAndEndAtTheImportedMesh) {
    for (unsigned seed = 0; seed < 1350 && !HasFailure(); ++seed) {
        SCOPED_TRACE(seed);
        const Cloth start = test::some_cloth(seed);
        MeshHistory history(start, seed);
        history.run(5, 8, 0.7);
        history.coarsen_all();
        expect_same(history.cloth, start);
    }
}

TEST(Sqrt3Mesh, DeepRefinementOfOneSpotComesBack) {
    for (unsigned seed = 0; seed < 18 && !HasFailure(); ++seed) {
        SCOPED_TRACE(seed);
        const Cloth start = test::some_cloth(seed);
        MeshHistory history(start, seed, 8);
        history.run(3, 40, 0.9);
        history.coarsen_all();
        expect_same(history.cloth, start);
    }
}

TEST(Sqrt3Mesh, TheMeshIsAFunctionOfTheVerticesPutIn) {
    for (unsigned seed = 0; seed < 450 && !HasFailure(); ++seed) {
        SCOPED_TRACE(seed);
        MeshHistory history(test::some_cloth(seed), seed);
        history.run(6, 10, 0.7);
        MeshHistory replay(test::some_cloth(seed), seed + 1);

        replay.insert(history.inserted());

        EXPECT_EQ(replay.inserted(), history.inserted());
        EXPECT_EQ(replay.content(), history.content());
    }
}

TEST(Sqrt3Mesh, NothingBesideTheClothMattersToWhatFollows) {
    for (unsigned seed = 0; seed < 90 && !HasFailure(); ++seed) {
        MeshHistory kept(test::some_cloth(seed), seed);
        MeshHistory resumed = kept;
        for (int i = 0; i < 6; ++i) {
            kept.run(1, 10, 0.6);
            resumed.mesh = Sqrt3Mesh(resumed.cloth); // as after a stop
            resumed.run(1, 10, 0.6);
        }
        EXPECT_EQ(kept.cloth.triangles, resumed.cloth.triangles);
        EXPECT_EQ(kept.cloth.rest_areas, resumed.cloth.rest_areas);
        EXPECT_EQ(kept.content(), resumed.content());
    }
}

TEST(Sqrt3Mesh, RefusedFlipsAndRemovalsAreMadeUpForLater) {
    for (unsigned seed = 0; seed < 630 && !HasFailure(); ++seed) {
        SCOPED_TRACE(seed);
        const Cloth start = test::some_cloth(seed);
        MeshHistory history(start, seed);
        history.refuse(0.4);
        history.run(5, 10, 0.7);
        history.refuse(0.0);
        history.retry_flips();
        EXPECT_TRUE(history.cloth.refinement.pending_flips.empty());
        MeshHistory replay(start, seed + 1);
        replay.insert(history.inserted());
        EXPECT_EQ(replay.content(), history.content());
        history.refuse(0.3);
        history.coarsen_all();
        expect_same(history.cloth, start);
    }
}

TEST(Sqrt3Mesh, WaitingFlipsAreKeptWhileEdgesMove) {
    for (unsigned seed = 0; seed < 90 && !HasFailure(); ++seed) {
        SCOPED_TRACE(seed);
        const Cloth start = test::some_cloth(seed);
        MeshHistory history(start, seed, 6);
        history.refuse(0.5);
        history.run(8, 30, 0.75);
        history.coarsen_all();
        expect_same(history.cloth, start);
    }
}

TEST(Sqrt3Mesh, AnglesAndValencesStayBounded) {
    struct Case {
        Sheet sheet;
        double least, greatest; // degrees
    };
    // Of the equilateral triangle the parts have 30 and 120 degrees, of the right-angled atan(1/3)
    // and 180 degrees less twice that.
    const double least = std::atan(1.0 / 3.0) * 180.0 / std::numbers::pi;
    for (const Case& c : {Case{equilateral_sheet(3, 3, 0.1), 30.0, 120.0},
                          Case{one_diagonal_sheet(3, 3, 1.0, 1.0), least, 180.0 - 2.0 * least},
                          Case{union_jack_sheet(4, 4, 1.0, 1.0), least, 180.0 - 2.0 * least}}) {
        // Each triangle around a vertex may be cut, which puts an edge into it, and wait.
        const std::size_t valence = 2 * greatest_valence(test::adaptive_sheet(c.sheet));
        for (unsigned seed = 0; seed < 20; ++seed) {
            MeshHistory history(test::adaptive_sheet(c.sheet), seed, 6);
            history.run(10, 20, 0.8);
            EXPECT_GE(angle_range(history.cloth)[0], c.least - 1e-9);
            EXPECT_LE(angle_range(history.cloth)[1], c.greatest + 1e-9);
            EXPECT_LE(greatest_valence(history.cloth), valence);
        }
    }
}

TEST(Sqrt3Mesh, AnglesDoNotDecayWithTheLevel) {
    // A triangle's own parts have about half of its least angle; what else is lost at the edges
    // must not add up over eight levels.
    for (unsigned seed = 0; seed < 6; ++seed) {
        const Sheet sheet = seed % 2 == 0 ? test::rough_sheet(3, 0.2, seed)
                                          : irregular_sheet(4, 4, 1.0, 1.0, 0.25, seed);
        const Cloth start = test::adaptive_sheet(sheet);
        MeshHistory history(start, seed, 8);
        for (int step = 0; step < 60; ++step) {
            history.refine_around({0.6, 0.4});
        }
        EXPECT_GE(history.finest_level(), 7);
        EXPECT_GT(angle_range(history.cloth)[0], 0.3 * angle_range(start)[0]);
    }
}

TEST(Sqrt3Mesh, NothingIsFinerThanTheLevelAllowed) {
    std::size_t triangles = 8;
    for (Index most = 1; most <= 3; ++most) {
        MeshHistory history(test::adaptive_sheet(union_jack_sheet(2, 2, 1.0, 1.0)), 1, most);

        for (int i = 0; i < 2 * most; ++i) {
            history.refine_all();
        }

        for (const TriangleLevel& level : history.cloth.refinement.triangles) {
            EXPECT_LE(level_of(level.generation), most);
        }
        triangles *= 3; // all of it is as fine as it may be
        EXPECT_EQ(history.cloth.triangles.size(), triangles);
    }
}

TEST(Sqrt3Mesh, NoHistoryGoesBeyondTheLevelAllowed) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        const Index most = 1 + static_cast<Index>(seed % 3);
        MeshHistory history(test::some_cloth(seed / 3), seed, most);
        history.refuse(0.2);
        history.run(6, 20, 0.8);
        history.refuse(0.0);
        for (int i = 0; i < 2 * most; ++i) {
            history.refine_all();
        }

        EXPECT_EQ(history.finest_level(), most);
    }
}

TEST(Sqrt3Mesh, FrozenTrianglesStayWhatTheyAre) {
    for (unsigned seed = 0; seed < 90; ++seed) {
        Cloth start = test::some_cloth(seed);
        const std::size_t frozen = seed % start.triangles.size();
        start.refinement.frozen[frozen] = 1;
        MeshHistory history(start, seed);

        history.run(5, 12, 0.9);

        EXPECT_EQ(history.cloth.triangles[frozen], start.triangles[frozen]);
        EXPECT_GT(history.cloth.triangles.size(), start.triangles.size());
    }
}

TEST(Sqrt3Mesh, ASeamStaysAndIsCutOnBothSidesAtOnce) {
    const Cloth start = test::seamed_sheet(4);
    std::size_t locked = 0;
    for (const std::uint8_t lock : start.refinement.locked) {
        locked += lock;
    }
    ASSERT_EQ(locked, 4u);
    MeshHistory history(start, 0);

    history.refine_all();
    history.refine_all();

    locked = 0;
    for (std::size_t e = 0; e < history.cloth.topology.edges.size(); ++e) {
        const MeshEdge& edge = history.cloth.topology.edges[e];
        if (history.cloth.refinement.locked[e] != 0) {
            ++locked;
            EXPECT_NEAR(history.cloth.material_positions[at(edge.v[0])].x(), 0.5, 1e-15);
            EXPECT_NEAR(history.cloth.material_positions[at(edge.v[1])].x(), 0.5, 1e-15);
        }
    }
    EXPECT_EQ(locked, 12u);
}

} // namespace weft
