#include "geometry/lattice_raster.h"
#include "geometry/winding_number.h"
#include "support/closed_meshes.h"

#include <gtest/gtest.h>

namespace weft {

using namespace test;

namespace {

/// Winding number by the sum over all triangles.
double slow_winding(const TriangleMesh& mesh, const Vec3& p) {
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
        const auto x = [&](std::size_t k) { return mesh.positions[at(t[k])]; };
        sum += winding_fraction(p, x(0), x(1), x(2));
    }
    return sum;
}

double volume_in(const LatticeRaster& raster) {
    double cells = 0.0;
    for (const Index cell : raster.cells) {
        cells += cell == LatticeRaster::k_full ? 1.0 : 0.0;
    }
    for (const LatticeBlock& block : raster.blocks) {
        for (const double fraction : block.fractions) {
            cells += fraction / 64.0;
        }
    }
    return cells * std::pow(raster.lattice.spacing, 3);
}

/// Calls f(middle of a fine cell, which fraction of it is inside, whether it is touched).
template <typename F> void for_each_fine(const LatticeRaster& raster, const F& f) {
    const auto& n = raster.lattice.size;
    for (std::size_t i = 0; i < raster.cells.size(); ++i) {
        const int c = static_cast<int>(i);
        const Vec3 low = raster.lattice.corner(c % n[0], c / n[0] % n[1], c / n[0] / n[1]);
        for (std::size_t k = 0; k < 64; ++k) {
            const Vec3 fine(static_cast<double>(k % 4) + 0.5, static_cast<double>(k / 4 % 4) + 0.5,
                            static_cast<double>(k / 16) + 0.5);
            const Index cell = raster.cells[i];
            const bool full = cell == LatticeRaster::k_full;
            const LatticeBlock block = cell >= 0 ? raster.blocks[at(cell)] : LatticeBlock{};
            f(Vec3(low + raster.lattice.spacing / 4.0 * fine), full ? 1.0 : block.fractions[k],
              full || (block.touched >> k & 1) != 0);
        }
    }
}

const TriangleMesh k_ell = cubes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});

} // namespace

TEST(LatticeRaster, SharesSumToTheVolumeOfTheMesh) {
    for (const TriangleMesh& mesh : {globe(0.5, 24, 12), torus(0.4, 0.15, 30, 12), k_ell}) {
        for (unsigned seed = 0; seed < 3; ++seed) {
            const TriangleMesh here = turned(mesh, seed);
            for (const double spacing : {0.08, 0.13, 0.7, 10.0}) {
                EXPECT_NEAR(volume_in(raster_closed(here, spacing)), volume_of(mesh),
                            1e-12 * std::max(1.0, std::pow(spacing, 3)));
            }
        }
    }
}

TEST(LatticeRaster, TellsInsideLikeTheWindingNumberOfEveryPoint) {
    for (unsigned seed = 0; seed < 4; ++seed) {
        const TriangleMesh mesh = turned(seed % 2 == 0 ? torus(0.4, 0.15, 12, 6) : k_ell, seed);
        int asked = 0;
        for_each_fine(raster_closed(mesh, 0.17), [&](const Vec3& p, double fraction, bool touched) {
            const bool is_whole = fraction < 1e-9 || fraction > 1.0 - 1e-9;
            if (is_whole) {
                EXPECT_EQ(fraction > 0.5, slow_winding(mesh, p) > 0.5);
                ++asked;
            }
            EXPECT_TRUE(touched || fraction < 1e-9);
        });
        EXPECT_GT(asked, 300);
    }
}

TEST(LatticeRaster, CubeWhoseFacesLieInPlanesOfTheLatticeTouchesNothingBesideIt) {
    const LatticeRaster raster = raster_closed(cubes({{0, 0, 0}}), 0.25);

    EXPECT_EQ(raster.lattice.size, (std::array<int, 3>{4, 4, 4}));
    for_each_fine(raster, [](const Vec3&, double fraction, bool touched) {
        EXPECT_EQ(fraction, 1.0);
        EXPECT_TRUE(touched);
    });
}

TEST(LatticeRaster, NotchInPlanesOfTheLatticeStaysUntouched) {
    const LatticeRaster raster = raster_closed(k_ell, 0.5);

    ASSERT_EQ(raster.lattice.size, (std::array<int, 3>{4, 4, 2}));
    for_each_fine(raster, [](const Vec3& p, double fraction, bool touched) {
        const bool in_notch = p.x() > 1.0 && p.y() > 1.0;
        EXPECT_EQ(fraction, in_notch ? 0.0 : 1.0);
        EXPECT_EQ(touched, !in_notch);
    });
}

TEST(LatticeRaster, CavityIsOutside) {
    TriangleMesh mesh = globe(0.5, 24, 12);
    const TriangleMesh cavity = globe(0.3, 24, 12);
    const auto first = static_cast<Index>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), cavity.positions.begin(), cavity.positions.end());
    for (const Triangle& t : cavity.triangles) {
        mesh.triangles.push_back({first + t[0], first + t[2], first + t[1]});
    }

    EXPECT_NEAR(volume_in(raster_closed(mesh, 0.07)), volume_of(mesh), 1e-12);
}

TEST(LatticeRaster, WindingNumberOfAClosedMeshFillsTheSame) {
    const TriangleMesh mesh = turned(torus(0.4, 0.15, 15, 8), 3);

    for_each_fine(raster_by_winding(mesh, 0.15), [&](const Vec3& p, double fraction, bool) {
        EXPECT_EQ(fraction > 0.5, slow_winding(mesh, p) > 0.5);
    });
}

TEST(LatticeRaster, WindingNumberFillsABowlWithoutItsLid) {
    TriangleMesh mesh = globe(0.5, 24, 12);
    const double whole = volume_of(mesh);
    mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(),
                                        [](const Triangle& t) { return t[0] == 0; }),
                         mesh.triangles.end());

    // The lid that is gone is 0.02 m high: 0.6 % of the volume.
    EXPECT_NEAR(volume_in(raster_by_winding(mesh, 0.1)), whole, 0.02 * whole);
}

TEST(WindingNumber, IsWithinAHundredthOfTheSumOverAllTriangles) {
    const TriangleMesh mesh = turned(torus(0.4, 0.15, 60, 24), 7);
    const WindingNumber winding(mesh);
    std::mt19937 engine(2);
    std::uniform_real_distribution<double> unit(-2.0, 2.0);

    for (int i = 0; i < 300; ++i) {
        const Vec3 p(unit(engine), unit(engine), unit(engine));
        EXPECT_NEAR(winding.around(p), slow_winding(mesh, p), 0.01);
    }
}

} // namespace weft
