#include "forces/stvk_triangle.h"

#include <cmath>

namespace weft {

namespace {

/// Stress C e of the Green strain.
MembraneStress green_stress(const Mat32& F, const MembraneStiffness& c) {
    const double e1 = 0.5 * (F.col(0).squaredNorm() - 1.0);
    const double e2 = 0.5 * (F.col(1).squaredNorm() - 1.0);
    return {c.c11 * e1 + c.c12 * e2, c.c33 * F.col(0).dot(F.col(1)), c.c12 * e1 + c.c22 * e2};
}

/// The nearest stress without compression.
MembraneStress without_compression(const MembraneStress& s) {
    const double mean = 0.5 * (s.s11 + s.s22);
    const double half = 0.5 * (s.s11 - s.s22);
    const double radius = std::sqrt(half * half + s.s12 * s.s12);
    if (mean >= radius) {
        return s;
    }
    if (mean <= -radius) {
        return {0.0, 0.0, 0.0};
    }
    const double high = mean + radius; // its eigenvector's projector is (1 + (s - mean)/radius)/2
    const double scale = 0.5 * high / radius;
    return {scale * (radius + half), scale * s.s12, scale * (radius - half)};
}

/// Derivatives of F.col(0) and F.col(1) by each corner: F.col(k) = sum of x_i g_i[k].
std::array<Vec2, 3> gradients(const RestTriangle& rest) {
    const Vec2 g1 = rest.inverse_edges.row(0).transpose();
    const Vec2 g2 = rest.inverse_edges.row(1).transpose();
    return {Vec2(-g1 - g2), g1, g2};
}

Corners forces_of(const Mat32& F,
                  const MembraneStress& s,
                  const Corners& v,
                  const RestTriangle& rest,
                  double damping) {
    const Vec3 p0 = rest.area * (F.col(0) * s.s11 + F.col(1) * s.s12);
    const Vec3 p1 = rest.area * (F.col(0) * s.s12 + F.col(1) * s.s22);
    const Mat2& g = rest.inverse_edges;
    const Vec3 f1 = -p0 * g(0, 0) - p1 * g(0, 1);
    const Vec3 f2 = -p0 * g(1, 0) - p1 * g(1, 1);
    Corners f{Vec3(-f1 - f2), f1, f2};
    if (damping > 0.0) {
        const Vec3 sum = v[0] + v[1] + v[2];
        for (std::size_t i = 0; i < 3; ++i) {
            f[i] -= 0.5 * damping * (3.0 * v[i] - sum);
        }
    }
    return f;
}

/// Second derivatives of W / A by the columns of F.
struct Curvature {
    Mat3 uu, uv, vv;
};

Curvature curvature(const Mat32& F, const MembraneStress& stress, const MembraneStiffness& c) {
    const MembraneStress s = without_compression(stress);
    const Vec3 U = F.col(0);
    const Vec3 V = F.col(1);
    const Mat3 UU = U * U.transpose();
    const Mat3 VV = V * V.transpose();
    Curvature k;
    k.uu = c.c11 * UU + c.c33 * VV;
    k.vv = c.c22 * VV + c.c33 * UU;
    k.uv = (c.c12 * U) * V.transpose() + (c.c33 * V) * U.transpose();
    k.uu.diagonal().array() += s.s11;
    k.vv.diagonal().array() += s.s22;
    k.uv.diagonal().array() += s.s12;
    return k;
}

} // namespace

double stvk_energy(const Corners& x, const RestTriangle& rest, const MembraneStiffness& c) {
    const Mat32 F = deformation_gradient(x, rest);
    const MembraneStress s = green_stress(F, c);
    return 0.5 * rest.area *
           (0.5 * s.s11 * (F.col(0).squaredNorm() - 1.0) +
            0.5 * s.s22 * (F.col(1).squaredNorm() - 1.0) + s.s12 * F.col(0).dot(F.col(1)));
}

Corners stvk_forces(const Corners& x,
                    const Corners& v,
                    const RestTriangle& rest,
                    const MembraneStiffness& c,
                    double damping) {
    const Mat32 F = deformation_gradient(x, rest);
    return forces_of(F, green_stress(F, c), v, rest, damping);
}

ElementTerms<3> stvk_terms(const Corners& x,
                           const Corners& v,
                           const RestTriangle& rest,
                           const MembraneStiffness& c,
                           double damping,
                           SystemScales scales) {
    const Mat32 F = deformation_gradient(x, rest);
    const MembraneStress stress = green_stress(F, c);
    ElementTerms<3> terms;
    terms.energy = stvk_energy(x, rest, c);
    terms.force = forces_of(F, stress, v, rest, damping);

    const Curvature k = curvature(F, stress, c);
    const std::array<Vec2, 3> g = gradients(rest);
    const double scale = scales.stiffness * rest.area;
    const double viscous = 0.5 * scales.damping * damping;
    const Mat3 vu = k.uv.transpose();
    for (int a = 0; a < 3; ++a) {
        const Vec2 ga = scale * g[at(a)];
        const Mat3 row_u = ga[0] * k.uu + ga[1] * vu;
        const Mat3 row_v = ga[0] * k.uv + ga[1] * k.vv;
        for (int b = a; b < 3; ++b) {
            const Vec2& gb = g[at(b)];
            Mat3& block = terms.stiffness[block_index(3, a, b)];
            block = row_u * gb[0] + row_v * gb[1];
            block.diagonal().array() += a == b ? 2.0 * viscous : -viscous;
        }
    }
    return terms;
}

MembraneStiffness stvk_stiffness(const ClothParams& cloth) {
    if (cloth.spring.calibrate) {
        return membrane_stiffness(cloth.fabric);
    }
    const double K = cloth.spring.K;
    FabricParams network;
    network.stretch_stiffness = Vec2::Constant(2.0 * K / std::sqrt(3.0));
    network.poisson = 1.0 / 3.0;
    network.shear_stiffness = std::sqrt(3.0) / 4.0 * K;
    return membrane_stiffness(network);
}

StvkTriangleElements::StvkTriangleElements(const Cloth& cloth)
    : stiffness_(stvk_stiffness(cloth.params)), damping_(cloth.params.spring.damping),
      rest_(cloth.rest) {
    set_triangles(cloth);
}

double StvkTriangleElements::energy_of(std::size_t t, std::span<const Vec3> x) const {
    return stvk_energy(gather(t, x), rest_[t], stiffness_);
}

Corners StvkTriangleElements::force_of(std::size_t t,
                                       std::span<const Vec3> x,
                                       std::span<const Vec3> v) const {
    return stvk_forces(gather(t, x), gather(t, v), rest_[t], stiffness_, damping_);
}

ElementTerms<3> StvkTriangleElements::terms_of(std::size_t t,
                                               std::span<const Vec3> x,
                                               std::span<const Vec3> v,
                                               SystemScales scales) const {
    return stvk_terms(gather(t, x), gather(t, v), rest_[t], stiffness_, damping_, scales);
}

} // namespace weft
