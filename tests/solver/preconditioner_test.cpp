#include "solver/conjugate_gradient.h"
#include "solver/preconditioner.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <random>

namespace weft {

namespace {

/// A sheet of rows x rows points with stiff links to the neighbours along both axes and diagonals,
/// and little mass: what acts at one end is felt at the other.
class StiffSheet {
public:
    explicit StiffSheet(Index side) {
        std::vector<BlockEntry> entries;
        for (Index i = 0; i < side * side; ++i) {
            places.push_back({0.1 * (i % side), 0.0, 0.1 * (i / side)});
        }
        std::vector<std::array<Index, 2>> links;
        for (Index i = 0; i < side * side; ++i) {
            for (const auto& [dx, dz] :
                 {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1), std::pair(-1, 1)}) {
                const Index x = i % side + dx;
                const Index z = i / side + dz;
                if (x >= 0 && x < side && z < side) {
                    links.push_back({i, z * side + x});
                    entries.push_back({i, z * side + x});
                }
            }
        }
        matrix = make_pattern(places.size(), entries);
        for (const Index d : matrix.diagonal) {
            matrix.blocks[static_cast<std::size_t>(d)] = 1e-3 * Mat3::Identity();
        }
        for (const auto& [a, b] : links) {
            const Vec3 n = (places[at(b)] - places[at(a)]).normalized();
            const Mat3 stiffness = n * n.transpose() + 0.05 * Mat3::Identity();
            block(a, a) += stiffness;
            block(b, b) += stiffness;
            block(a, b) -= stiffness;
            block(b, a) -= stiffness;
        }
        fixed.assign(places.size(), 0);
    }

    /// Makes a row the identity, as held vertices have it.
    void fix(Index row) {
        fixed[at(row)] = 1;
        for (Index k = matrix.row_begin[at(row)]; k < matrix.row_begin[at(row) + 1]; ++k) {
            const Index column = matrix.column[at(k)];
            block(row, column).setZero();
            block(column, row).setZero();
        }
        block(row, row) = Mat3::Identity();
    }

    BlockMatrix matrix;
    std::vector<Vec3> places;
    std::vector<char> fixed;

private:
    Mat3& block(Index row, Index column) {
        return matrix.blocks[at(find_block(matrix, row, column))];
    }
};

std::vector<Vec3> random_values(std::size_t count, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    std::vector<Vec3> values(count);
    for (Vec3& v : values) {
        v = {value(engine), value(engine), value(engine)};
    }
    return values;
}

std::vector<Vec3> correction(CoarseSpace& coarse, std::span<const Vec3> r) {
    std::vector<Vec3> z(r.size(), Vec3::Zero());
    coarse.add_correction(r, z);
    return z;
}

} // namespace

TEST(CoarseSpace, CutsEveryRowIntoOneConnectedPatch) {
    const StiffSheet sheet(30);
    CoarseSpace coarse;
    coarse.set_pattern(sheet.matrix);

    ASSERT_GT(coarse.patch_count(), 4U);
    std::vector<int> sizes(coarse.patch_count(), 0);
    for (const Index patch : coarse.patch_of_row()) {
        ASSERT_GE(patch, 0);
        ++sizes[static_cast<std::size_t>(patch)];
    }
    EXPECT_GT(*std::min_element(sizes.begin(), sizes.end()), 900 / 32 / 4);
}

TEST(CoarseSpace, SolvesRigidMotionsOfPatchesExactly) {
    // For z in the span of P, the correction of A z is z.
    StiffSheet sheet(30);
    sheet.fix(17);
    CoarseSpace coarse;
    coarse.set_pattern(sheet.matrix);
    coarse.build(sheet.matrix, sheet.places, sheet.fixed);
    const std::size_t rows = sheet.places.size();
    std::vector<Vec3> motion(rows), push(rows);
    const std::vector<Vec3> velocity = random_values(coarse.patch_count(), 1);
    const std::vector<Vec3> spin = random_values(coarse.patch_count(), 2);
    for (std::size_t i = 0; i < rows; ++i) {
        const auto patch = static_cast<std::size_t>(coarse.patch_of_row()[i]);
        motion[i] = sheet.fixed[i] != 0
                        ? Vec3(Vec3::Zero())
                        : Vec3(velocity[patch] + spin[patch].cross(sheet.places[i]));
    }
    multiply(sheet.matrix, motion, push);

    const std::vector<Vec3> found = correction(coarse, push);
    for (std::size_t i = 0; i < rows; ++i) {
        EXPECT_LT((found[i] - motion[i]).norm(), 1e-4) << i; // the shift, beside a mass of 1e-3
    }
}

TEST(CoarseSpace, IsSymmetricAndNeverNegative) {
    const StiffSheet sheet(24);
    CoarseSpace coarse;
    coarse.set_pattern(sheet.matrix);
    coarse.build(sheet.matrix, sheet.places, sheet.fixed);
    for (unsigned seed = 0; seed < 5; ++seed) {
        const std::vector<Vec3> a = random_values(sheet.places.size(), seed);
        const std::vector<Vec3> b = random_values(sheet.places.size(), seed + 50);
        const std::vector<Vec3> ca = correction(coarse, a);
        const std::vector<Vec3> cb = correction(coarse, b);
        EXPECT_NEAR(dot(ca, b), dot(a, cb), 1e-9 * std::abs(dot(ca, a)));
        EXPECT_GE(dot(ca, a), 0.0);
    }
}

TEST(CoarseSpace, CarriesAcrossTheSheetInFewerIterations) {
    const StiffSheet sheet(60);
    IncompleteCholesky fine;
    fine.factor(sheet.matrix);
    CoarseSpace coarse;
    coarse.set_pattern(sheet.matrix);
    coarse.build(sheet.matrix, sheet.places, sheet.fixed);
    const std::vector<Vec3> b = random_values(sheet.places.size(), 3);
    const auto iterations = [&](bool with_coarse) {
        std::vector<Vec3> x(b.size(), Vec3::Zero());
        const CgReport report =
            ConjugateGradient().solve(sheet.matrix,
                                      [&](std::span<const Vec3> r, std::span<Vec3> z) {
                                          fine.apply(r, z);
                                          if (with_coarse) {
                                              coarse.add_correction(r, z);
                                          }
                                      },
                                      b, x, {.tolerance = 1e-6});
        EXPECT_TRUE(report.converged);
        return report.iterations;
    };

    EXPECT_LT(2 * iterations(true), iterations(false));
}

TEST(CoarseSpace, StandsAsideForFewRows) {
    const StiffSheet sheet(5);
    CoarseSpace coarse;
    coarse.set_pattern(sheet.matrix);
    coarse.build(sheet.matrix, sheet.places, sheet.fixed);

    EXPECT_TRUE(coarse.is_empty());
    for (const Vec3& z : correction(coarse, random_values(25, 4))) {
        EXPECT_EQ(z, Vec3::Zero());
    }
}

} // namespace weft
