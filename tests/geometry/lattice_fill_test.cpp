#include "geometry/lattice_fill.h"
#include "support/closed_meshes.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace weft {

using namespace test;

namespace {

Vec3 place_of(const LatticeFill& fill, const LatticePlace& place) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < 4 && place.particles[k] != k_no_index; ++k) {
        sum += place.weights[k] * fill.particles[at(place.particles[k])];
    }
    return sum;
}

/// Pieces that hang together by edges.
int piece_count(const LatticeFill& fill) {
    std::vector<Index> piece(fill.particles.size());
    std::iota(piece.begin(), piece.end(), 0);
    const auto find = [&](Index i) {
        while (piece[at(i)] != i) {
            i = piece[at(i)];
        }
        return i;
    };
    for (const LatticeEdge& edge : lattice_edges(fill)) {
        piece[at(std::max(find(edge.particles[0]), find(edge.particles[1])))] =
            std::min(find(edge.particles[0]), find(edge.particles[1]));
    }
    std::set<Index> roots;
    for (Index i = 0; i < static_cast<Index>(piece.size()); ++i) {
        roots.insert(find(i));
    }
    return static_cast<int>(roots.size());
}

LatticeFill fill_mesh(const TriangleMesh& mesh, double spacing) {
    return fill_lattice(raster_closed(mesh, spacing), mesh);
}

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

TriangleMesh slab(double thickness) {
    TriangleMesh mesh = cubes({{0, 0, 0}});
    for (Vec3& x : mesh.positions) {
        x.y() *= thickness;
    }
    return mesh;
}

TriangleMesh both(TriangleMesh a, const TriangleMesh& b, const Vec3& shift) {
    const auto first = static_cast<Index>(a.positions.size());
    for (const Vec3& x : b.positions) {
        a.positions.push_back(x + shift);
    }
    for (const Triangle& t : b.triangles) {
        a.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return a;
}

} // namespace

TEST(LatticeFill, BoxOfEightCellsASideHas729ParticlesAndItsMassByVolume) {
    const LatticeFill fill = fill_box({8, 8, 8}, 0.02);

    EXPECT_EQ(fill.particles.size(), 729U);
    EXPECT_EQ(fill.cells.size(), 512U);
    EXPECT_EQ(fill.surface.positions.size(), 729U - 343U);
    EXPECT_EQ(fill.surface.triangles.size(), 6U * 64U * 2U);
    EXPECT_NEAR(volume_of(fill.surface), 0.16 * 0.16 * 0.16, 1e-15);
    // Interior 1, face 1/2, edge 1/4, corner 1/8 of 0.02^3 m^3.
    std::array<int, 4> counts{};
    for (const double volume : fill.volumes) {
        for (std::size_t k = 0; k < 4; ++k) {
            counts[k] += std::abs(volume - 8e-6 / (1 << k)) < 1e-15 ? 1 : 0;
        }
    }
    EXPECT_EQ(counts, (std::array<int, 4>{343, 6 * 49, 12 * 7, 8}));
}

TEST(LatticeFill, BoxHasThe26NeighboursOfEachParticle) {
    const LatticeFill fill = fill_box({3, 3, 3}, 0.5);
    std::vector<int> neighbours(fill.particles.size(), 0);
    std::array<int, 3> kinds{};
    for (const LatticeEdge& edge : lattice_edges(fill)) {
        ++neighbours[at(edge.particles[0])];
        ++neighbours[at(edge.particles[1])];
        ++kinds[static_cast<std::size_t>(edge.kind)];
        const double length =
            (fill.particles[at(edge.particles[0])] - fill.particles[at(edge.particles[1])]).norm();
        EXPECT_NEAR(length, 0.5 * std::sqrt(static_cast<double>(edge.kind) + 1.0), 1e-15);
    }

    EXPECT_EQ(neighbours[21], 26); // (1, 1, 1)
    EXPECT_EQ(neighbours[0], 7);
    EXPECT_EQ(kinds, (std::array<int, 3>{3 * 48, 3 * 72, 4 * 27}));
}

TEST(LatticeFill, MeshOfABoxInPlanesOfTheLatticeIsFilledLikeTheBox) {
    TriangleMesh mesh = scaled(cubes({{0, 0, 0}, {1, 0, 0}}), 0.5);
    const LatticeFill fill = fill_mesh(mesh, 0.125);
    const LatticeFill box = fill_box({8, 4, 4}, 0.125);

    EXPECT_EQ(fill.particles.size(), box.particles.size());
    EXPECT_EQ(fill.cells.size(), box.cells.size());
    std::vector<double> a = fill.volumes;
    std::vector<double> b = box.volumes;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(a[i], b[i], 1e-15);
    }
    for (const LatticePlace& place : fill.places) {
        EXPECT_EQ(place.weights[0], 1.0); // on a particle
    }
}

TEST(LatticeFill, WeightsArePositiveAndGiveThePlacesOfTheSurface) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        const TriangleMesh mesh = turned(seed % 2 == 0 ? torus(0.4, 0.15, 30, 12)
                                                       : cubes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
                                         seed);
        const LatticeFill fill = fill_mesh(mesh, 0.09);
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const LatticePlace& place = fill.places[v];
            EXPECT_LT((place_of(fill, place) - mesh.positions[v]).norm(), 1e-12);
            double total = 0.0;
            for (const double weight : place.weights) {
                EXPECT_GE(weight, 0.0);
                total += weight;
            }
            EXPECT_NEAR(total, 1.0, 1e-14);
        }
    }
}

TEST(LatticeFill, VolumesSumToThatOfTheMeshAndItsCentreStaysNear) {
    for (unsigned seed = 0; seed < 3; ++seed) {
        const TriangleMesh mesh = turned(globe(0.5, 24, 12), seed);
        const LatticeFill fill = fill_mesh(mesh, 0.1);
        Vec3 moment = Vec3::Zero();
        for (std::size_t i = 0; i < fill.particles.size(); ++i) {
            moment += fill.volumes[i] * fill.particles[i];
        }

        EXPECT_NEAR(sum(fill.volumes), volume_of(mesh), 1e-12);
        // The middle of a fine cell stands for what is inside of it: 0.0125 m at most, and on
        // both sides of a ball alike.
        const Vec3 centre = turned({{Vec3::Zero()}, {}}, seed).positions[0];
        EXPECT_LT((moment / sum(fill.volumes) - centre).norm(), 1e-3);
    }
}

TEST(LatticeFill, ThinWallStaysInOnePiece) {
    for (const double thickness : {0.3, 1e-2, 1e-4}) {
        for (unsigned seed = 0; seed < 5; ++seed) {
            const TriangleMesh mesh = turned(slab(thickness), seed);
            const LatticeFill fill = fill_mesh(mesh, 0.15);

            EXPECT_EQ(piece_count(fill), 1);
            EXPECT_NEAR(sum(fill.volumes), thickness, 1e-12);
        }
    }
}

TEST(LatticeFill, PartsSideBySideInOneCellAreJoinedOnlyWhenVeryNear) {
    const TriangleMesh wall = slab(0.1);

    // Spacing 1: one cell across. Gap 0.6: two fine cells are free at least. Gap 0.1: none.
    EXPECT_EQ(piece_count(fill_mesh(both(wall, wall, Vec3(0.0, 0.7, 0.0)), 1.0)), 2);
    EXPECT_EQ(piece_count(fill_mesh(both(wall, wall, Vec3(0.0, 0.2, 0.0)), 1.0)), 1);
}

TEST(LatticeFill, LegsThatPassThroughTheSameCellsAreHeldTogetherOnlyWhereTheyMeet) {
    // A U whose legs are 1 wide and 3 apart, in cells of 5: both legs pass through the upper cell.
    std::vector<std::array<int, 3>> corners{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    for (int y = 0; y < 10; ++y) {
        corners.insert(corners.end(), {{0, y, 0}, {4, y, 0}});
    }
    const TriangleMesh u = cubes(corners);
    const LatticeFill fill = fill_mesh(u, 5.0);

    EXPECT_EQ(piece_count(fill), 1);
    EXPECT_EQ(fill.cells.size(), 3U); // the bend, and a cell for each leg
    EXPECT_EQ(fill.particles.size(), 8U + 4U + 4U);
}

TEST(LatticeFill, CellTetrahedraFillTheCell) {
    const LatticeFill fill = fill_box({1, 1, 1}, 1.0);
    double volume = 0.0;
    for (const auto& tetrahedron : k_cell_tetrahedra) {
        const auto x = [&](std::size_t k) {
            return fill.particles[at(fill.cells[0][at(tetrahedron[k])])];
        };
        const double part = (x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0)) / 6.0;
        EXPECT_NEAR(part, 1.0 / 6.0, 1e-15);
        volume += part;
    }
    EXPECT_NEAR(volume, 1.0, 1e-15);
}

TEST(LatticeFill, MassesSumToTheWholeAndNoneIsTiny) {
    for (const double thickness : {1.0, 0.01, 1e-6}) {
        const LatticeFill fill = fill_mesh(turned(slab(thickness), 1), 0.2);
        const std::vector<double> masses = lattice_masses(fill, 0.7);

        EXPECT_NEAR(sum(masses), 0.7, 1e-14);
        const double mean = 0.7 / static_cast<double>(masses.size());
        EXPECT_GT(*std::min_element(masses.begin(), masses.end()), mean / 100.0);
    }
}

TEST(LatticeFill, MassesOfABoxAreNotChanged) {
    const LatticeFill fill = fill_box({4, 4, 4}, 0.25);
    const std::vector<double> masses = lattice_masses(fill, 2.0);

    for (std::size_t i = 0; i < masses.size(); ++i) {
        EXPECT_NEAR(masses[i], 2.0 * fill.volumes[i], 1e-15);
    }
}

TEST(LatticeFill, SameMeshGivesTheSameBits) {
    const TriangleMesh mesh = turned(torus(0.4, 0.15, 30, 12), 5);
    const LatticeFill a = fill_mesh(mesh, 0.08);
    const LatticeFill b = fill_mesh(mesh, 0.08);

    EXPECT_EQ(a.particles, b.particles);
    EXPECT_EQ(a.volumes, b.volumes);
    EXPECT_EQ(a.cells, b.cells);
}

} // namespace weft
