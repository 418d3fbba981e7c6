#include "scene/law_shape.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {
namespace {

/// p and q of the coefficients that the four conditions of Vogiannou et al. 2010 (8) give, solved
/// as they stand: a L^3 + b L^2 + c L + d = 0 and 3 a r^2 + 2 b r + c = K, K1, K2 at L, a1 L, a2 L.
LawShape solved_shape(const SpringParams& s, double L) {
    Eigen::Matrix4d A;
    A.row(0) << L * L * L, L * L, L, 1.0;
    const std::array<double, 3> lengths{L, s.a1 * L, s.a2 * L};
    for (int i = 0; i < 3; ++i) {
        const double r = lengths[static_cast<std::size_t>(i)];
        A.row(i + 1) << 3.0 * r * r, 2.0 * r, 1.0, 0.0;
    }
    const Eigen::Vector4d x = A.fullPivLu().solve(Eigen::Vector4d(0.0, s.K, s.K1, s.K2));
    const double q = 3.0 * L * L * x[0] / s.K; // a = K q / (3 L^2), b = K (p - 2 q) / (2 L)
    return {2.0 * L * x[1] / s.K + 2.0 * q, q};
}

TEST(LawShape, SolvesTheFourConditionsOfThePaper) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        const SpringParams params{.K = 500.0,
                                  .K1 = 500.0 * (1.0 + 9.0 * share(random)),
                                  .K2 = 500.0 * (1.0 + 9.0 * share(random)),
                                  .a1 = 1.05 + share(random),
                                  .a2 = 0.95 - 0.9 * share(random)};

        const LawShape shape = law_shape(Model::Cubic, params);

        const LawShape solved = solved_shape(params, 1.0);
        const double size = std::abs(shape.p) + std::abs(shape.q) + 1.0;
        EXPECT_NEAR(shape.p, solved.p, 1e-10 * size);
        EXPECT_NEAR(shape.q, solved.q, 1e-10 * size);
    }
}

TEST(LawShape, IsThatOfThePapersFigures) {
    const auto shape = [](double K1, double K2, double a1, double a2) {
        return law_shape(Model::Cubic, {.K = 1.0, .K1 = K1, .K2 = K2, .a1 = a1, .a2 = a2});
    };
    const auto expect = [](const LawShape& shape, double p, double q) {
        EXPECT_NEAR(shape.p, p, 1e-10 * q);
        EXPECT_NEAR(shape.q, q, 1e-10 * q);
    };
    expect(shape(2.0, 2.0, 1.1, 0.9), 0.0, 100.0); // figure 2
    expect(shape(4.0, 2.0, 1.1, 0.9), 10.0, 200.0);
    expect(shape(6.0, 2.0, 1.1, 0.9), 20.0, 300.0);    // and figure 5
    expect(shape(6.0, 2.0, 1.04, 0.96), 50.0, 1875.0); // figure 4
    expect(shape(6.0, 10.0, 1.1, 0.9), -20.0, 700.0);  // figure 6
}

TEST(LawShape, TellsWhereStiffnessIsNegative) {
    // 1 + p e + q e^2 = 0 by hand
    EXPECT_TRUE(softening(LawShape{0.0, 0.0}).empty());
    EXPECT_TRUE(softening(LawShape{20.0, 300.0}).empty()); // 400 < 1200
    ASSERT_EQ(softening(LawShape{3.0, 1.5}).size(), 1U);   // (3 s^2 - 1) / 2
    EXPECT_EQ(softening(LawShape{3.0, 1.5})[0].from, 0.0);
    EXPECT_NEAR(softening(LawShape{3.0, 1.5})[0].to, std::sqrt(1.0 / 3.0), 1e-15);
    ASSERT_EQ(softening(LawShape{-5.0, 4.0}).size(), 1U); // (1 - e) (1 - 4 e)
    EXPECT_NEAR(softening(LawShape{-5.0, 4.0})[0].from, 1.25, 1e-15);
    EXPECT_NEAR(softening(LawShape{-5.0, 4.0})[0].to, 2.0, 1e-15);
    ASSERT_EQ(softening(LawShape{0.0, -4.0}).size(), 2U); // 1 - 4 e^2
    EXPECT_NEAR(softening(LawShape{0.0, -4.0})[0].to, 0.5, 1e-15);
    EXPECT_NEAR(softening(LawShape{0.0, -4.0})[1].from, 1.5, 1e-15);
    ASSERT_EQ(softening(LawShape{-2.0, 0.0}).size(), 1U); // 1 - 2 e
    EXPECT_NEAR(softening(LawShape{-2.0, 0.0})[0].from, 1.5, 1e-15);
}

TEST(LawShape, LeavesOutWhatALimitKeepsEdgesFrom) {
    EXPECT_EQ(softening_text(Model::StvkEdge, {}),
              "stiffness is negative below the stretch 0.5774");
    EXPECT_EQ(softening_text(Model::StvkEdge, {.limit = {0.9, 1.1}}), "");
    EXPECT_EQ(softening_text(Model::Cubic, {}), "");
}

} // namespace
} // namespace weft
