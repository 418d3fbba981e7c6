#include "forces/stvk_triangle.h"
#include "support/derivatives.h"

#include <gtest/gtest.h>

namespace weft {

using namespace test;

namespace {

const MembraneStiffness k_stiffness{900.0, 250.0, 1200.0, 300.0};

RestTriangle rest_triangle() {
    Mat2 edges;
    edges << 0.03, 0.01, -0.004, 0.025;
    return {edges.inverse(), 0.5 * edges.determinant()};
}

/// The triangle under F, turned and moved somewhere.
VecX deformed(const Mat2& F, std::mt19937& random) {
    const Mat3 R = random_rotation(random);
    const Mat2 edges = F * rest_triangle().inverse_edges.inverse();
    VecX x = VecX::Zero(9);
    for (int k = 1; k < 3; ++k) {
        x.segment<3>(3 * k) = R.leftCols<2>() * edges.col(k - 1);
    }
    for (int k = 0; k < 3; ++k) {
        x.segment<3>(3 * k) += Vec3(0.1, -0.2, 0.3);
    }
    return x;
}

ElementTerms<3> terms_at(const VecX& x) {
    return stvk_terms(corners<3>(x), corners<3>(VecX::Zero(9)), rest_triangle(), k_stiffness, 0.0,
                      {});
}

Mat2 matrix(double a, double b, double c, double d) {
    Mat2 F;
    F << a, b, c, d;
    return F;
}

const std::vector<Mat2> k_stretched{matrix(1.0, 0.0, 0.0, 1.0), matrix(1.3, 0.05, 0.0, 1.1),
                                    matrix(2.0, 0.1, 0.1, 1.5)};
const std::vector<Mat2> k_pressed{matrix(0.6, 0.0, 0.0, 0.9), matrix(0.1, 0.3, 0.0, 1.2),
                                  matrix(1.0, 1.0, 1.0, 1.0), matrix(0.0, 0.0, 0.0, 0.0)};

} // namespace

TEST(StvkTriangle, ForceIsTheSlopeOfItsEnergy) {
    std::mt19937 random(1);
    for (const auto& cases : {k_stretched, k_pressed}) {
        for (const Mat2& F : cases) {
            const VecX x = deformed(F, random);

            const VecX slope =
                numerical_gradient([](const VecX& at) { return terms_at(at).energy; }, x, 1e-7);

            const VecX force = flat<3>(terms_at(x).force);
            EXPECT_LT((slope + force).norm(), 1e-7 * (1.0 + force.norm())) << F;
            const Corners alone = stvk_forces(corners<3>(x), corners<3>(VecX::Zero(9)),
                                              rest_triangle(), k_stiffness, 0.0);
            EXPECT_LT((flat<3>(alone) - force).norm(), 1e-12 * (1.0 + force.norm()));
        }
    }
}

TEST(StvkTriangle, MatrixIsTheSlopeOfItsForceUnderTension) {
    std::mt19937 random(2);
    for (const Mat2& F : k_stretched) {
        const VecX x = deformed(F, random);

        const MatX slope =
            numerical_jacobian([](const VecX& at) { return flat<3>(terms_at(at).force); }, x, 1e-8);

        const MatX K = assembled<3>(terms_at(x).stiffness);
        EXPECT_LT((K + slope).norm(), 1e-6 * K.norm()) << F;
    }
}

TEST(StvkTriangle, MatrixIsPositiveSemidefiniteUnderPressure) {
    std::mt19937 random(3);
    for (const Mat2& F : k_pressed) {
        const MatX K = assembled<3>(terms_at(deformed(F, random)).stiffness);

        ASSERT_TRUE(K.allFinite());
        EXPECT_GT(eigenvalues(K).minCoeff(), -1e-12 * (1.0 + K.norm()));
    }
}

TEST(StvkTriangle, IsAtRestInItsRestShapeAndSumsToNoForceOrTorque) {
    std::mt19937 random(4);
    EXPECT_LT(flat<3>(terms_at(deformed(Mat2::Identity(), random)).force).norm(), 1e-10);
    const VecX x = deformed(k_stretched[1], random);
    const auto f = terms_at(x).force;
    const Vec3 torque =
        x.segment<3>(0).cross(f[0]) + x.segment<3>(3).cross(f[1]) + x.segment<3>(6).cross(f[2]);
    EXPECT_LT((f[0] + f[1] + f[2]).norm(), 1e-12);
    EXPECT_LT(torque.norm(), 1e-12);
}

TEST(StvkTriangle, PullsByHalfOfStretchSquaredLessOne) {
    std::mt19937 random(5);
    const VecX x = deformed(matrix(1.2, 0.0, 0.0, 1.0), random);

    // e_uu = 0.22 alone: W = A c11 e^2 / 2
    EXPECT_NEAR(terms_at(x).energy, 0.5 * rest_triangle().area * 900.0 * 0.22 * 0.22, 1e-12);
}

TEST(StvkTriangle, DampingIsHalfOfThatOfEachEdge) {
    std::mt19937 random(6);
    const VecX x = deformed(Mat2::Identity(), random);
    VecX v(9);
    v << 1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 3.0;

    const ElementTerms<3> terms =
        stvk_terms(corners<3>(x), corners<3>(v), rest_triangle(), k_stiffness, 0.4, {0.0, 1.0});

    EXPECT_LT((terms.force[0] - Vec3(-0.4, 0.4, 0.6)).norm(), 1e-9);
    EXPECT_LT((assembled<3>(terms.stiffness) * v + flat<3>(terms.force)).norm(), 1e-9);
}

TEST(StvkTriangle, HasTheModuliOfANetworkOfEquilateralTriangles) {
    // plane stress of the network: c11 = 3 sqrt(3)/4 K, c12 = c33 = sqrt(3)/4 K
    ClothParams cloth;
    cloth.spring.K = 1000.0;
    const MembraneStiffness c = stvk_stiffness(cloth);
    EXPECT_NEAR(c.c11, 0.75 * std::sqrt(3.0) * 1000.0, 1e-9);
    EXPECT_NEAR(c.c22, c.c11, 1e-9);
    EXPECT_NEAR(c.c12, 0.25 * std::sqrt(3.0) * 1000.0, 1e-9);
    EXPECT_NEAR(c.c33, c.c12, 1e-9);
}

} // namespace weft
