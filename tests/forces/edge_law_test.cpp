#include "forces/edge_law.h"
#include "support/derivatives.h"

#include <gtest/gtest.h>

namespace weft {

using namespace test;

namespace {

const SpringParams k_figure5{.K = 500.0, .K1 = 3000.0, .K2 = 1000.0, .a1 = 1.1, .a2 = 0.9};
constexpr double k_length = 0.02;

EdgeLaw law_of(Model model, const SpringParams& params = k_figure5) {
    return {.shape = law_shape(model, params)};
}

ElementTerms<2> terms_at(const VecX& x,
                         const EdgeLaw& law,
                         const VecX& v = VecX::Zero(6),
                         SystemScales scales = {}) {
    return edge_terms(corners<2>(x), corners<2>(v), k_figure5.K, k_length, law, scales);
}

/// An edge at a stretch, somewhere and in some direction.
VecX edge_at(double stretch, std::mt19937& random) {
    std::normal_distribution<double> normal;
    const Vec3 middle = 0.1 * Vec3(normal(random), normal(random), normal(random));
    const Vec3 half = 0.5 * stretch * k_length * random_rotation(random).col(0);
    VecX x(6);
    x << middle - half, middle + half;
    return x;
}

EdgeLaw limited(EdgeLaw law) {
    law.limit = {0.9, 1.1, 10.0};
    return law;
}

std::vector<EdgeLaw> every_law() {
    std::vector<EdgeLaw> laws{law_of(Model::Linear), law_of(Model::StvkEdge), law_of(Model::Cubic)};
    laws.push_back(limited(laws[0]));
    laws.push_back(limited(laws[2]));
    return laws;
}

const std::vector<double> k_stretches{0.05, 0.5, 0.896, 0.95, 1.0, 1.04, 1.1052, 1.3, 2.0, 10.0};

} // namespace

TEST(EdgeLaw, ForceIsTheSlopeOfItsEnergy) {
    std::mt19937 random(1);
    for (const EdgeLaw& law : every_law()) {
        for (const double stretch : k_stretches) {
            const VecX x = edge_at(stretch, random);

            const VecX slope = numerical_gradient(
                [&](const VecX& at) { return terms_at(at, law).energy; }, x, 1e-7);

            const VecX force = flat<2>(terms_at(x, law).force);
            EXPECT_LT((slope + force).norm(), 1e-6 * (1.0 + force.norm())) << stretch;
        }
    }
}

TEST(EdgeLaw, MatrixIsTheSlopeOfItsForceUnderTension) {
    std::mt19937 random(2);
    for (const EdgeLaw& law : every_law()) {
        for (const double stretch : {1.0 + 1e-9, 1.04, 1.1052, 1.3, 2.0}) {
            const VecX x = edge_at(stretch, random);

            const MatX slope = numerical_jacobian(
                [&](const VecX& at) { return flat<2>(terms_at(at, law).force); }, x, 1e-8);

            const MatX K = assembled<2>(terms_at(x, law).stiffness);
            EXPECT_LT((K + slope).norm(), 1e-5 * K.norm()) << stretch;
        }
    }
}

TEST(EdgeLaw, MatrixAlongACompressedEdgeIsTheSlopeToo) {
    std::mt19937 random(3);
    const EdgeLaw law = law_of(Model::Cubic);
    for (const double stretch : {0.05, 0.5, 0.9, 0.97}) {
        const VecX x = edge_at(stretch, random);
        const Vec3 n = (x.head<3>() - x.tail<3>()).normalized();

        const Mat3 block = terms_at(x, law).stiffness[0];

        const double e = stretch - 1.0; // g' of the figure: K (1 + 20 e + 300 e^2)
        EXPECT_NEAR(n.dot(block * n), 500.0 * (1.0 + 20.0 * e + 300.0 * e * e), 1e-7);
        EXPECT_NEAR(block.trace(), n.dot(block * n), 1e-7); // nothing across
    }
}

TEST(EdgeLaw, MatrixIsPositiveSemidefiniteAnywhere) {
    std::mt19937 random(4);
    for (const EdgeLaw& law : every_law()) {
        for (const double stretch :
             {0.0, 1e-12, 1e-3, 0.3, 0.57, 0.89, 0.9, 1.0, 1.1, 1.5, 100.0}) {
            const ElementTerms<2> terms = terms_at(edge_at(stretch, random), law);

            const MatX K = assembled<2>(terms.stiffness);

            ASSERT_TRUE(K.allFinite() && terms.force[0].allFinite()) << stretch;
            EXPECT_GE(eigenvalues(K).minCoeff(), -1e-12 * K.norm());
        }
    }
}

TEST(EdgeLaw, ForcesSumToZeroAndDoNotTurnTheEdge) {
    std::mt19937 random(5);
    for (const EdgeLaw& law : every_law()) {
        for (const double stretch : k_stretches) {
            const VecX x = edge_at(stretch, random);
            const auto f = terms_at(x, law).force;
            EXPECT_EQ(f[0], Vec3(-f[1]));
            EXPECT_LE((x.head<3>() - x.tail<3>()).cross(f[0]).norm(), 1e-12 * f[0].norm());
        }
    }
}

TEST(EdgeLaw, HasTheCoefficientsOfThePapersFigures) {
    const auto expect = [](double K, double L, LawShape shape, CubicCoefficients figure) {
        const CubicCoefficients k = cubic_coefficients(shape, K, L);
        EXPECT_NEAR(k.a, figure.a, 1e-5 * std::abs(figure.a));
        EXPECT_NEAR(k.b, figure.b, 1e-5 * std::abs(figure.b));
        EXPECT_NEAR(k.c, figure.c, 1e-5 * std::abs(figure.c));
        EXPECT_NEAR(k.d, figure.d, 1e-5 * std::abs(figure.d));
    };
    expect(1.0, 1.0, {0.0, 100.0}, {33.33333, -100.0, 101.0, -34.33333}); // figure 2, K1 = 2 K
    expect(1.0, 1.0, {20.0, 300.0}, {100.0, -290.0, 281.0, -91.0});       // figure 2, K1 = 6 K
    expect(1000.0, 0.02, {50.0, 1875.0}, {1.5625e9, -9.25e7, 1.826e6, -12020.0});   // figure 4
    expect(500.0, 0.02, {20.0, 300.0}, {1.25e8, -7.25e6, 140500.0, -910.0});        // figure 5
    expect(1000.0, 0.02, {-20.0, 700.0}, {5.83333e8, -3.55e7, 721000.0, -4886.67}); // figure 6
}

TEST(EdgeLaw, PullsAsTheFullCubicFormDoes) {
    const LawShape shape{20.0, 300.0};
    const auto [a, b, c, d] = cubic_coefficients(shape, 500.0, k_length);
    for (const double s : k_stretches) {
        const double r = s * k_length;
        const EdgeResponse response = edge_response(shape, 500.0, k_length, s);
        EXPECT_NEAR(response.tension, ((a * r + b) * r + c) * r + d, 1e-11 * a * r * r * r + 1e-9);
        EXPECT_NEAR(response.stiffness, (3.0 * a * r + 2.0 * b) * r + c, 1e-6 * response.stiffness);
    }
}

TEST(EdgeLaw, TakesTheEnergyOfItsFormToCollapse) {
    const auto collapse = [](LawShape shape) { return edge_response(shape, 1.0, 1.0, 0.0).energy; };
    EXPECT_NEAR(collapse({}), 0.5, 1e-15); // of K L^2
    EXPECT_NEAR(collapse({3.0, 1.5}), 0.125, 1e-15);
    EXPECT_NEAR(collapse({0.0, 100.0}), 0.5 + 100.0 / 12.0, 1e-13); // 8.833
    EXPECT_NEAR(collapse({50.0, 1875.0}), 0.5 - 50.0 / 6.0 + 1875.0 / 12.0, 1e-12);
}

TEST(EdgeLaw, IsTheTwoTermLawWithoutARootForStvkEdge) {
    const LawShape shape = law_shape(Model::StvkEdge, {});
    for (const double s : k_stretches) {
        const EdgeResponse response = edge_response(shape, 2.0, 3.0, s);
        EXPECT_NEAR(response.tension, 2.0 * 3.0 * 0.5 * (s * s * s - s), 1e-10 * (1.0 + s * s * s));
        EXPECT_NEAR(response.energy, 2.0 / (8.0 * 9.0) * std::pow(9.0 * (s * s - 1.0), 2),
                    1e-10 * (1.0 + std::pow(s, 4)));
    }
}

TEST(EdgeLaw, DampsAlongTheRelativeVelocityOfItsEnds) {
    std::mt19937 random(6);
    EdgeLaw law = law_of(Model::Cubic);
    law.damping = 0.3;
    const VecX x = edge_at(1.0, random);
    VecX v(6);
    v << 1.0, 2.0, 3.0, -1.0, 0.5, 0.25;

    const ElementTerms<2> terms = terms_at(x, law, v, {0.0, 1.0});

    EXPECT_LT((terms.force[0] + 0.3 * (v.head<3>() - v.tail<3>())).norm(), 1e-9);
    EXPECT_LT((terms.stiffness[0] - 0.3 * Mat3::Identity()).norm(), 1e-12);
    EXPECT_LT((terms.stiffness[1] + 0.3 * Mat3::Identity()).norm(), 1e-12);
}

TEST(EdgeLaw, ScalingBAndDInTheJacobianStiffensAnEdgeAtRestManyTimes) {
    // 1 + 0.02 |b| L / K along, 0.01 (|b| L + |d| / L) / K across
    struct Figure {
        LawShape shape;
        double along, across;
    };
    std::mt19937 random(7);
    for (const Figure& figure :
         {Figure{{20.0, 300.0}, 6.8, 3.81}, Figure{{50.0, 1875.0}, 38.0, 24.51},
          Figure{{-20.0, 700.0}, 15.2, 9.5433}}) {
        EdgeLaw law{.shape = figure.shape, .jacobian_damping = 0.99};
        const VecX x = edge_at(1.0, random);
        const Vec3 n = (x.head<3>() - x.tail<3>()).normalized();

        const ElementTerms<2> terms = terms_at(x, law);

        const double K = k_figure5.K;
        const double along = n.dot(terms.stiffness[0] * n);
        EXPECT_NEAR(along, figure.along * K, 1e-3 * K);
        EXPECT_NEAR(0.5 * (terms.stiffness[0].trace() - along), figure.across * K, 1e-3 * K);
        EXPECT_LT(terms.force[0].norm(), 1e-9); // what it comes to rest under is the same
    }
}

TEST(EdgeLaw, LimitHoldsManyTimesItsForceWithinOnePercent) {
    const StretchLimit limit{0.9, 1.1, 10.0};
    for (const auto& [stretch, sign] : {std::pair{1.1 * 1.0095, 1.0}, {0.9 * 0.9905, -1.0}}) {
        EXPECT_NEAR(limit_response(limit, 1.0, stretch).tension, sign * 10.0 * 18.05, 1e-6);
    }
    for (const double stretch : {0.9, 1.0, 1.1}) {
        EXPECT_EQ(limit_response(limit, 1.0, stretch).tension, 0.0) << stretch;
        EXPECT_EQ(limit_response(limit, 1.0, stretch).stiffness, 0.0) << stretch;
    }
    EXPECT_GT(limit_response(limit, 1.0, 1.1 * 1.01).tension, 10.0 * 37.0);
}

} // namespace weft
