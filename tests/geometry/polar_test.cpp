#include "geometry/polar.h"

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include <random>

namespace weft {

namespace {

Mat32 random_gradient(std::mt19937& random) {
    std::normal_distribution<double> normal;
    Mat32 F;
    for (int i = 0; i < 6; ++i) {
        F(i / 2, i % 2) = normal(random);
    }
    return F;
}

Mat2 stretch_of(const PolarFactor& p) {
    Mat2 S;
    S << p.s11, p.s12, p.s12, p.s22;
    return S;
}

} // namespace

TEST(PolarFactor, AgreesWithTheSingularValueDecomposition) {
    std::mt19937 random(2);
    for (int i = 0; i < 1000; ++i) {
        const Mat32 F = random_gradient(random);
        const Eigen::JacobiSVD<Eigen::MatrixXd> svd(F, Eigen::ComputeThinU | Eigen::ComputeThinV);
        const Eigen::MatrixXd expected = svd.matrixU() * svd.matrixV().transpose();

        const PolarFactor p = polar_decompose(F);

        EXPECT_LT((p.R - expected).norm(), 1e-12 / svd.singularValues()(1));
        EXPECT_LT((p.R * stretch_of(p) - F).norm(), 1e-14 * F.norm());
        EXPECT_NEAR(p.determinant, svd.singularValues().prod(), 1e-13 * F.squaredNorm());
        EXPECT_LT((principal_stretches(F) - Vec2(svd.singularValues())).norm(), 1e-13 * F.norm());
    }
}

TEST(PolarFactor, StaysOrthonormalWhenTheTriangleCollapses) {
    std::mt19937 random(3);
    for (const double thin : {1e-3, 1e-7, 1e-10, 1e-15, 0.0}) {
        Mat32 F = random_gradient(random);
        F.col(1) = 1.7 * F.col(0) + thin * F.col(1);

        const PolarFactor p = polar_decompose(F);

        // The normal of a nearly collapsed triangle is known to rounding over its thinness only.
        const double accuracy = thin > 0.0 ? std::max(1e-14, std::min(1e-14 / thin, 1e-3)) : 1e-14;
        EXPECT_LT((p.R.transpose() * p.R - Mat2::Identity()).norm(), accuracy) << thin;
        EXPECT_LT((p.R * stretch_of(p) - F).norm(), 1e-14 * F.norm() + accuracy * thin) << thin;
        EXPECT_NEAR(p.normal.norm(), 1.0, 1e-14) << thin;
    }
}

TEST(PolarFactor, OfAPointIsFinite) {
    const PolarFactor p = polar_decompose(Mat32::Zero());

    EXPECT_EQ(p.R.transpose() * p.R, Mat2::Identity());
    EXPECT_EQ(stretch_of(p), Mat2::Zero());
    EXPECT_EQ(principal_stretches(Mat32::Zero()), Vec2::Zero());
}

TEST(PolarFactor, OfARotationIsTheRotation) {
    const Mat3 turn = Eigen::AngleAxisd(2.9, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();

    const PolarFactor p = polar_decompose(turn.leftCols<2>());

    EXPECT_LT((p.R - turn.leftCols<2>()).norm(), 1e-15);
    EXPECT_LT((p.normal - turn.col(2)).norm(), 1e-15);
}

} // namespace weft
