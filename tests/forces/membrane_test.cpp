#include "forces/membrane.h"
#include "support/derivatives.h"
#include "support/sheets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace weft {

using namespace test;

namespace {

const FabricParams k_orthotropic{
    .stretch_stiffness = {1500.0, 600.0}, .shear_stiffness = 90.0, .poisson = 0.35};

RestTriangle rest_of(const Vec2& m0, const Vec2& m1, const Vec2& m2) {
    Mat2 edges;
    edges << m1 - m0, m2 - m0;
    return {edges.inverse(), 0.5 * edges.determinant()};
}

const RestTriangle k_rest = rest_of({0.1, 0.0}, {0.9, 0.2}, {0.3, 0.8});

/// Corners of k_rest under x = F m, with noise of the given size.
Corners deformed(const Mat32& F, std::mt19937& random, double noise = 0.0) {
    std::normal_distribution<double> normal(0.0, 1.0);
    const auto m = rest_corners(k_rest);
    Corners x;
    for (std::size_t k = 0; k < 3; ++k) {
        x[k] = F * m[k] + noise * Vec3(normal(random), normal(random), normal(random));
    }
    return x;
}

Mat32 gradient(double s11, double s12, double s22, std::mt19937& random) {
    Mat2 S;
    S << s11, s12, s12, s22;
    return Mat32(random_rotation(random).leftCols<2>() * S);
}

double energy_of(const VecX& x) {
    return membrane_energy(corners<3>(x), k_rest, membrane_stiffness(k_orthotropic));
}

VecX force_of(const VecX& x) {
    const Corners zero{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    return flat<3>(
        membrane_forces(corners<3>(x), zero, k_rest, membrane_stiffness(k_orthotropic), 0.0));
}

} // namespace

TEST(Membrane, ForceIsTheNegativeGradientOfTheEnergy) {
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        const VecX x = flat<3>(deformed(gradient(1.2, 0.1, 0.9, random), random, 0.3));

        const VecX expected = -numerical_gradient(energy_of, x, 1e-6);

        EXPECT_LT((force_of(x) - expected).norm(), 1e-7 * (1.0 + expected.norm()));
    }
}

TEST(Membrane, ForceIsTheGradientForNearlyCollapsedTriangles) {
    std::mt19937 random(2);
    for (const double thin : {1e-1, 1e-2, 1e-3, 1e-4}) {
        const VecX x = flat<3>(deformed(gradient(1.3, 0.0, thin, random), random));

        const VecX expected = -numerical_gradient(energy_of, x, 1e-3 * thin);

        EXPECT_LT((force_of(x) - expected).norm(), 1e-4 * expected.norm()) << thin;
    }
}

TEST(Membrane, ForceIsFiniteOnALineAndInAPoint) {
    std::mt19937 random(3);
    const Mat32 line = gradient(1.0, 0.0, 0.0, random);
    for (const Mat32& F : {line, Mat32(Mat32::Zero()), Mat32(1e-160 * line)}) {
        const Corners x = deformed(F, random);
        const Corners rest_velocity{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};

        const ElementTerms<3> terms = membrane_terms(
            x, rest_velocity, k_rest, membrane_stiffness(k_orthotropic), 0.01, {1.0, 1.0});

        EXPECT_TRUE(flat<3>(terms.force).allFinite());
        EXPECT_TRUE(assembled<3>(terms.stiffness).allFinite());
        EXPECT_TRUE(std::isfinite(terms.energy));
    }
}

TEST(Membrane, RigidMotionCostsNothing) {
    std::mt19937 random(4);
    for (int i = 0; i < 20; ++i) {
        Corners x = deformed(gradient(1.0, 0.0, 1.0, random), random);
        for (Vec3& corner : x) {
            corner += Vec3(10.0, -20.0, 5.0);
        }

        EXPECT_LT(energy_of(flat<3>(x)), 1e-24 * 1500.0);
        EXPECT_LT(force_of(flat<3>(x)).norm(), 1e-11 * 1500.0);
    }
}

TEST(Membrane, ForcesHaveNoSumAndNoTorque) {
    std::mt19937 random(5);
    for (int i = 0; i < 100; ++i) {
        // 30 % strain, sheared: the state in which the classic corotational force has a torque
        const Corners x = deformed(gradient(1.3, 0.2, 0.8, random), random, 0.1);
        const Corners v = deformed(gradient(0.5, -1.2, 2.0, random), random, 1.0);

        const Corners f = membrane_forces(x, v, k_rest, membrane_stiffness(k_orthotropic), 0.02);

        const Vec3 torque = x[0].cross(f[0]) + x[1].cross(f[1]) + x[2].cross(f[2]);
        const double scale = f[0].norm() + f[1].norm() + f[2].norm();
        EXPECT_LT((f[0] + f[1] + f[2]).norm(), 1e-14 * scale);
        EXPECT_LT(torque.norm(), 1e-13 * scale);
    }
}

TEST(Membrane, ExactHessianIsTheDerivativeOfTheForce) {
    std::mt19937 random(6);
    for (int i = 0; i < 200; ++i) {
        const Corners x = deformed(gradient(1.1, 0.1, 0.9, random), random, 0.2);
        const PolarFactor polar = polar_decompose(deformation_gradient(x, k_rest));
        const MembraneHessian exact =
            membrane_hessian(polar, membrane_stiffness(k_orthotropic)); // not projected

        const MatX K = assembled<3>(membrane_blocks(exact, polar, k_rest, 1.0));

        const MatX expected = -numerical_jacobian(force_of, flat<3>(x), 1e-6);
        EXPECT_LT((K - expected).norm(), 1e-6 * expected.norm()) << i;
    }
}

TEST(Membrane, ExactHessianHoldsForThinTrianglesAndLargeStretch) {
    std::mt19937 random(7);
    for (const Vec2& s : {Vec2(4.0, 0.05), Vec2(0.2, 0.1), Vec2(1.0, 0.02), Vec2(3.0, 3.0)}) {
        const Corners x = deformed(gradient(s(0), 0.0, s(1), random), random);
        const PolarFactor polar = polar_decompose(deformation_gradient(x, k_rest));

        const MatX K = assembled<3>(membrane_blocks(
            membrane_hessian(polar, membrane_stiffness(k_orthotropic)), polar, k_rest, 1.0));

        const MatX expected = -numerical_jacobian(force_of, flat<3>(x), 1e-4 * s(1));
        EXPECT_LT((K - expected).norm(), 1e-5 * expected.norm()) << s.transpose();
    }
}

TEST(Membrane, ProjectedStiffnessIsPositiveSemidefinite) {
    std::mt19937 random(8);
    for (int i = 0; i < 500; ++i) {
        const Corners x = deformed(gradient(0.9, 0.1, 0.7, random), random, i % 2 ? 0.5 : 0.05);
        const Corners v = deformed(gradient(0.9, 0.1, 0.7, random), random, 1.0);

        const ElementTerms<3> terms =
            membrane_terms(x, v, k_rest, membrane_stiffness(k_orthotropic), 0.01, {1.0, 100.0});

        const VecX values = eigenvalues(assembled<3>(terms.stiffness));
        EXPECT_GT(values.minCoeff(), -1e-12 * values.maxCoeff());
    }
}

TEST(Membrane, ProjectionLeavesAStretchedTriangleAlone) {
    std::mt19937 random(9);
    const PolarFactor polar = polar_decompose(gradient(1.3, 0.02, 1.25, random));
    const MembraneHessian exact = membrane_hessian(polar, membrane_stiffness(k_orthotropic));

    MembraneHessian projected = exact;
    project(projected);

    EXPECT_EQ(projected.spin, exact.spin);
    EXPECT_EQ(projected.y11, exact.y11);
    EXPECT_EQ(projected.y12, exact.y12);
    EXPECT_EQ(projected.y22, exact.y22);
}

TEST(Membrane, TensionHoldsTheTriangleInItsPlane) {
    // Isotropic, stretched to s on both axes: p/s = C (s - 1)/s per slope; 2Y = that (Hessian 1.5).
    const FabricParams isotropic{
        .stretch_stiffness = {1000.0, 1000.0}, .shear_stiffness = 400.0, .poisson = 0.25};
    std::mt19937 random(10);
    const double s = 1.2;

    const MembraneHessian h = membrane_hessian(polar_decompose(gradient(s, 0.0, s, random)),
                                               membrane_stiffness(isotropic));

    const double tension = 1000.0 / (1.0 - 0.25) * (s - 1.0); // E / (1 - nu) * strain
    EXPECT_NEAR(h.y11, tension / s, 1e-10 * tension);
    EXPECT_NEAR(h.y22, tension / s, 1e-10 * tension);
    EXPECT_NEAR(h.y12, 0.0, 1e-10 * tension);
}

TEST(Membrane, DampingMatrixIsTheDerivativeOfTheForceByVelocity) {
    std::mt19937 random(11);
    const MembraneStiffness c = membrane_stiffness(k_orthotropic);
    const Corners x = deformed(gradient(1.1, 0.1, 0.8, random), random, 0.2);
    const VecX v = flat<3>(deformed(gradient(0.3, -0.5, 1.0, random), random, 1.0));
    const auto force = [&](const VecX& velocity) {
        return flat<3>(membrane_forces(x, corners<3>(velocity), k_rest, c, 0.03));
    };

    const ElementTerms<3> terms = membrane_terms(x, corners<3>(v), k_rest, c, 0.03, {0.0, 1.0});

    const MatX expected = -numerical_jacobian(force, v, 1e-3);
    EXPECT_LT((assembled<3>(terms.stiffness) - expected).norm(), 1e-9 * expected.norm());
}

TEST(Membrane, DampingIsZeroInRigidMotion) {
    std::mt19937 random(12);
    const MembraneStiffness c = membrane_stiffness(k_orthotropic);
    const Corners x = deformed(gradient(1.3, 0.1, 0.8, random), random, 0.1);
    Corners v;
    for (std::size_t k = 0; k < 3; ++k) {
        v[k] = Vec3(1.0, 2.0, 3.0) + Vec3(3.0, -1.0, 2.0).cross(x[k]);
    }

    const VecX damped = flat<3>(membrane_forces(x, v, k_rest, c, 0.1));

    const VecX elastic = force_of(flat<3>(x));
    EXPECT_LT((damped - elastic).norm(), 1e-13 * elastic.norm());
}

TEST(Membrane, PatchTestHoldsOnAnIrregularMesh) {
    const Sheet sheet = irregular_sheet(6, 5, 0.6, 0.5, 0.3, 1);
    const MembraneElements membrane(cloth_of(sheet, k_orthotropic));
    Mat32 F;
    F << 1.2, 0.1, -0.3, 0.9, 0.2, 0.4;
    const std::vector<Vec3> x = placed(sheet, [&](const Vec2& m) { return Vec3(F * m); });
    const std::vector<Vec3> v(x.size(), Vec3::Zero());
    std::vector<Vec3> element_forces(3 * membrane.size());

    membrane.forces(x, v, element_forces);

    std::vector<Vec3> force(x.size(), Vec3::Zero());
    double scale = 0.0;
    for (std::size_t i = 0; i < element_forces.size(); ++i) {
        force[at(membrane.nodes()[i])] += element_forces[i];
        scale = std::max(scale, element_forces[i].norm());
    }
    for (int j = 1; j < 5; ++j) {
        for (int i = 1; i < 6; ++i) {
            EXPECT_LT(force[at(j * 7 + i)].norm(), 1e-12 * scale);
        }
    }
}

TEST(Membrane, OffAxisModulusFollowsTheOrthotropicFormula) {
    // docs/methods.md, 9.5: 1/E(t) = c^4/E1 + s^4/E2 + (1/G - 2 nu12/E1) c^2 s^2, nu12 = 0.25 of E1
    const double e1 = 1500.0, e2 = 600.0, g = 90.0, nu12 = 0.25;
    const FabricParams fabric{
        .stretch_stiffness = {e1, e2}, .shear_stiffness = g, .poisson = nu12 * std::sqrt(e2 / e1)};
    const MembraneStiffness c = membrane_stiffness(fabric);
    Mat3 C;
    C << c.c11, c.c12, 0, c.c12, c.c22, 0, 0, 0, c.c33;
    for (const double degrees : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
        const double cosine = std::cos(degrees * M_PI / 180.0);
        const double sine = std::sin(degrees * M_PI / 180.0);
        // small uniaxial stress along the direction; its strain as an affine field
        const double sigma = 1e-4;
        const Vec3 strain = C.inverse() * Vec3(cosine * cosine, sine * sine, cosine * sine) * sigma;
        Mat32 F = Mat32::Zero();
        F.topRows<2>() << 1.0 + strain(0), strain(2) / 2, strain(2) / 2, 1.0 + strain(1);

        const MembraneStress s = membrane_stress(polar_decompose(F), c);

        const Vec2 along(cosine, sine);
        Mat2 S;
        S << s.s11, s.s12, s.s12, s.s22;
        const double extension = (F.topRows<2>() * along).dot(along) - 1.0;
        const double modulus = along.dot(S * along) / extension;
        const double expected = 1.0 / (std::pow(cosine, 4) / e1 + std::pow(sine, 4) / e2 +
                                       (1.0 / g - 2.0 * nu12 / e1) * cosine * cosine * sine * sine);
        EXPECT_NEAR(modulus, expected, 1e-6 * expected) << degrees;
    }
}

TEST(Membrane, ForcesAloneAreThoseOfTheFullEvaluation) {
    const Sheet sheet = irregular_sheet(20, 20, 0.6, 0.5, 0.3, 2);
    FabricParams fabric = k_orthotropic;
    fabric.damping = {0.0, 0.01};
    const MembraneElements membrane(cloth_of(sheet, fabric));
    const auto x =
        placed(sheet, [](const Vec2& m) { return Vec3(m.x(), std::sin(9 * m.x()), m.y()); });
    const auto v = placed(sheet, [](const Vec2& m) { return Vec3(m.y() * m.x(), m.x(), 1.0); });
    std::vector<Vec3> alone(3 * membrane.size()), full(3 * membrane.size());
    std::vector<Mat3> blocks(6 * membrane.size());

    membrane.forces(x, v, alone);
    membrane.evaluate(x, v, {1.0, 1.0}, full, blocks);

    EXPECT_EQ(alone, full);
}

namespace {

const RestTriangle k_unit_rest{Mat2::Identity(), 0.5};
const MembraneStiffness k_unit_stiffness = membrane_stiffness(
    {.stretch_stiffness = {1000.0, 400.0}, .shear_stiffness = 50.0, .poisson = 0.0});

/// Corners of a triangle whose weft and warp become the given vectors.
Corners from_yarns(const Vec3& weft, const Vec3& warp) {
    return {Vec3(1, 2, 3), Vec3(Vec3(1, 2, 3) + weft), Vec3(Vec3(1, 2, 3) + warp)};
}

} // namespace

TEST(Strain, StretchAlongWeftIsSeenThereAlone) {
    const auto m =
        strain_measures(from_yarns({0, 1.25, 0}, {0, 0, 1}), k_unit_rest, k_unit_stiffness);

    EXPECT_NEAR(m.stretch_max, 1.25, 1e-14);
    EXPECT_NEAR(m.stretch_min, 1.0, 1e-14);
    EXPECT_NEAR(m.strain_weft, 0.25, 1e-14);
    EXPECT_NEAR(m.strain_warp, 0.0, 1e-14);
    EXPECT_NEAR(m.shear_deg, 0.0, 1e-12);
    EXPECT_NEAR(m.tension, 1000.0 * 0.25, 1e-10);
}

TEST(Strain, ShearIsTheLossOfTheRightAngle) {
    // yarns keep their length and meet at 70 degrees: stretches are sqrt(2) cos, sin of 35 degrees
    const double angle = 70.0 * M_PI / 180.0;

    const auto m = strain_measures(from_yarns({1, 0, 0}, {std::cos(angle), std::sin(angle), 0}),
                                   k_unit_rest, k_unit_stiffness);

    EXPECT_NEAR(m.shear_deg, 20.0, 1e-12);
    EXPECT_NEAR(m.strain_weft, 0.0, 1e-14);
    EXPECT_NEAR(m.strain_warp, 0.0, 1e-14);
    EXPECT_NEAR(m.stretch_max, std::sqrt(2.0) * std::cos(angle / 2), 1e-14);
    EXPECT_NEAR(m.stretch_min, std::sqrt(2.0) * std::sin(angle / 2), 1e-14);
}

TEST(Strain, OfACollapsedTriangleIsFinite) {
    const auto m =
        strain_measures(from_yarns(Vec3::Zero(), Vec3::Zero()), k_unit_rest, k_unit_stiffness);

    EXPECT_EQ(m.stretch_max, 0.0);
    EXPECT_EQ(m.stretch_min, 0.0);
    EXPECT_EQ(m.shear_deg, 0.0);
    EXPECT_NEAR(m.tension, -400.0, 1e-10); // both compressed by 100 %; the softer one is greater
}

} // namespace weft
