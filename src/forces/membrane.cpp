#include "forces/membrane.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

// The gradient. dW = A sigma : dS with S dS + dS S = F^T dF + dF^T F, hence with the symmetric Y of
// S Y + Y S = sigma it is dW/dF = 2 A F Y = A R (2 S Y). In two dimensions
//
//     2 S Y = (S sigma + sigma adj S) / tr S
//
// which divides by nothing smaller than tr S: a triangle may collapse onto a line.
// With dE = R^T dF (2×2) write dE = dS + w J S, J the quarter turn. This solves
// S dS + dS S = S dE + dE^T S without dividing by anything smaller than tr S, and in
//
//     d2W/A = e^T C e + 2 Y : (dF^T dF - dS dS)
//
// the second term becomes 2 w (sym J Z) : dS + w^2 S : sigma, with Z of local_piola_stress, plus
// the out-of-plane slopes. C is positive definite, so the in-plane form is positive semidefinite
// exactly when its Schur complement spin - h^T C^-1 h is not negative: one number to clamp where
// others need the eigenvectors of a 4×4 matrix.
namespace weft {

namespace {

/// F (C tau dE/dt): the damping part of the first Piola stress.
Mat32 damping_stress(const Mat32& F, const Mat32& rate, const MembraneStiffness& c, double tau) {
    const double e1 = tau * F.col(0).dot(rate.col(0));
    const double e2 = tau * F.col(1).dot(rate.col(1));
    const double shear = tau * c.c33 * (F.col(0).dot(rate.col(1)) + F.col(1).dot(rate.col(0)));
    Mat32 P;
    P.col(0) = F.col(0) * (c.c11 * e1 + c.c12 * e2) + F.col(1) * shear;
    P.col(1) = F.col(0) * shear + F.col(1) * (c.c12 * e1 + c.c22 * e2);
    return P;
}

} // namespace

Mat32 deformation_gradient(const Corners& x, const RestTriangle& rest) {
    const Vec3 d1 = x[1] - x[0];
    const Vec3 d2 = x[2] - x[0];
    const Mat2& g = rest.inverse_edges;
    Mat32 F;
    F.col(0) = d1 * g(0, 0) + d2 * g(1, 0);
    F.col(1) = d1 * g(0, 1) + d2 * g(1, 1);
    return F;
}

MembraneStress membrane_stress(const PolarFactor& polar, const MembraneStiffness& c) {
    const double e1 = polar.s11 - 1.0;
    const double e2 = polar.s22 - 1.0;
    return {c.c11 * e1 + c.c12 * e2, 2.0 * c.c33 * polar.s12, c.c12 * e1 + c.c22 * e2};
}

Mat2 local_piola_stress(const PolarFactor& polar, const MembraneStress& s) {
    const double trace = polar.s11 + polar.s22;
    const double inverse = trace > 0.0 ? 1.0 / trace : 0.0;
    const double twist = polar.s12 * (s.s22 - s.s11);
    Mat2 Z;
    Z << s.s11, (2.0 * polar.s11 * s.s12 + twist) * inverse, //
        (2.0 * polar.s22 * s.s12 - twist) * inverse, s.s22;
    return Z;
}

double membrane_energy(const PolarFactor& polar, double rest_area, const MembraneStiffness& c) {
    const MembraneStress s = membrane_stress(polar, c);
    return 0.5 * rest_area *
           (s.s11 * (polar.s11 - 1.0) + s.s22 * (polar.s22 - 1.0) + 2.0 * s.s12 * polar.s12);
}

double membrane_energy(const Corners& x, const RestTriangle& rest, const MembraneStiffness& c) {
    return membrane_energy(polar_decompose(deformation_gradient(x, rest)), rest.area, c);
}

Corners membrane_forces(const Mat32& F,
                        const PolarFactor& polar,
                        const Corners& v,
                        const RestTriangle& rest,
                        const MembraneStiffness& c,
                        double damping_time) {
    const Mat2 Z = local_piola_stress(polar, membrane_stress(polar, c));
    Mat32 P;
    P.col(0) = polar.R.col(0) * Z(0, 0) + polar.R.col(1) * Z(1, 0);
    P.col(1) = polar.R.col(0) * Z(0, 1) + polar.R.col(1) * Z(1, 1);
    if (damping_time > 0.0) {
        P += damping_stress(F, deformation_gradient(v, rest), c, damping_time);
    }
    const Mat2& g = rest.inverse_edges;
    const Vec3 f1 = -rest.area * (P.col(0) * g(0, 0) + P.col(1) * g(0, 1));
    const Vec3 f2 = -rest.area * (P.col(0) * g(1, 0) + P.col(1) * g(1, 1));
    return {Vec3(-f1 - f2), f1, f2};
}

Corners membrane_forces(const Corners& x,
                        const Corners& v,
                        const RestTriangle& rest,
                        const MembraneStiffness& c,
                        double damping_time) {
    const Mat32 F = deformation_gradient(x, rest);
    return membrane_forces(F, polar_decompose(F), v, rest, c, damping_time);
}

StrainMeasures
strain_measures(const Corners& x, const RestTriangle& rest, const MembraneStiffness& c) {
    const Mat32 F = deformation_gradient(x, rest);
    const Vec2 stretch = principal_stretches(F);
    const MembraneStress s = membrane_stress(polar_decompose(F), c);
    StrainMeasures measures{};
    measures.stretch_max = stretch(0);
    measures.stretch_min = stretch(1);
    const double weft = F.col(0).norm();
    const double warp = F.col(1).norm();
    measures.strain_weft = weft - 1.0;
    measures.strain_warp = warp - 1.0;
    if (weft > 0.0 && warp > 0.0) {
        const double cosine = std::clamp(F.col(0).dot(F.col(1)) / (weft * warp), -1.0, 1.0);
        measures.shear_deg = std::asin(cosine) * 180.0 / std::numbers::pi;
    }
    measures.tension = 0.5 * (s.s11 + s.s22) + std::hypot(0.5 * (s.s11 - s.s22), s.s12);
    return measures;
}

namespace {

/// Linear map from displacements (u1x, u1y, u2x, u2y) of corners 1 and 2 on the axes of R to four
/// strain coordinates; [a] is the image of displacement a.
using StrainMap = std::array<std::array<double, 4>, 4>;

/// Symmetric 4×4 matrix, upper triangle used.
using Form = std::array<std::array<double, 4>, 4>;

/// The map to (dS11, dS22, 2 dS12, w).
StrainMap strain_map(const PolarFactor& p, const Mat2& gradients) {
    const double trace = p.s11 + p.s22;
    const double inverse = trace > 0.0 ? 1.0 / trace : 0.0; // a point does not spin
    const double difference = p.s22 - p.s11;
    StrainMap map;
    for (std::size_t i = 0; i < 2; ++i) {
        const double gx = gradients(static_cast<int>(i), 0);
        const double gy = gradients(static_cast<int>(i), 1);
        const double wx = -gy * inverse;
        const double wy = gx * inverse;
        map[2 * i] = {gx + p.s12 * wx, -p.s12 * wx, gy + difference * wx, wx};
        map[2 * i + 1] = {p.s12 * wy, gy - p.s12 * wy, gx + difference * wy, wy};
    }
    return map;
}

/// The map to the Green strain (dE11, dE22, 2 dE12, 0).
StrainMap green_strain_map(const PolarFactor& p, const Mat2& gradients) {
    StrainMap map;
    for (std::size_t i = 0; i < 2; ++i) {
        const double gx = gradients(static_cast<int>(i), 0);
        const double gy = gradients(static_cast<int>(i), 1);
        map[2 * i] = {p.s11 * gx, p.s12 * gy, p.s11 * gy + p.s12 * gx, 0.0};
        map[2 * i + 1] = {p.s12 * gx, p.s22 * gy, p.s12 * gy + p.s22 * gx, 0.0};
    }
    return map;
}

/// Adds scale * map^T H map with H the in-plane part of `form`.
void add_pulled_back(Form& k, const StrainMap& map, const MembraneHessian& form, double scale) {
    for (std::size_t b = 0; b < 4; ++b) {
        const auto& m = map[b];
        const double f1 = scale * (form.c.c11 * m[0] + form.c.c12 * m[1] + form.h1 * m[3]);
        const double f2 = scale * (form.c.c12 * m[0] + form.c.c22 * m[1] + form.h2 * m[3]);
        const double f3 = scale * (form.c.c33 * m[2] + form.h3 * m[3]);
        const double f4 =
            scale * (form.h1 * m[0] + form.h2 * m[1] + form.h3 * m[2] + form.spin * m[3]);
        for (std::size_t a = 0; a <= b; ++a) {
            k[a][b] += map[a][0] * f1 + map[a][1] * f2 + map[a][2] * f3 + map[a][3] * f4;
        }
    }
}

/// a r1 r1^T + b r1 r2^T + c r2 r1^T + d r2 r2^T + e n n^T
Mat3 in_frame(const PolarFactor& p, double a, double b, double c, double d, double e) {
    const Vec3 r1 = p.R.col(0);
    const Vec3 r2 = p.R.col(1);
    const Vec3 left1 = a * r1 + c * r2;
    const Vec3 left2 = b * r1 + d * r2;
    const Vec3 left3 = e * p.normal;
    Mat3 block;
    for (int j = 0; j < 3; ++j) {
        block.col(j) = left1 * r1(j) + left2 * r2(j) + left3 * p.normal(j);
    }
    return block;
}

/// The six blocks from the in-plane form k and the tension 2Y; corner 0 moves against the others.
std::array<Mat3, 6> corner_blocks(const Form& k,
                                  const MembraneHessian& h,
                                  double tension_scale,
                                  const PolarFactor& p,
                                  const Mat2& g) {
    const auto tension = [&](int i, int j) {
        return tension_scale * (g(i, 0) * (h.y11 * g(j, 0) + h.y12 * g(j, 1)) +
                                g(i, 1) * (h.y12 * g(j, 0) + h.y22 * g(j, 1)));
    };
    const Mat3 k11 = in_frame(p, k[0][0], k[0][1], k[0][1], k[1][1], tension(0, 0));
    const Mat3 k12 = in_frame(p, k[0][2], k[0][3], k[1][2], k[1][3], tension(0, 1));
    const Mat3 k22 = in_frame(p, k[2][2], k[2][3], k[2][3], k[3][3], tension(1, 1));
    const Mat3 k01 = -k11 - k12.transpose();
    const Mat3 k02 = -k12 - k22;
    return {Mat3(-k01 - k02), k01, k02, k11, k12, k22};
}

/// Clamps the negative eigenvalues of [[y11, y12], [y12, y22]] to zero.
void clamp_negative(double& y11, double& y12, double& y22) {
    const double mean = 0.5 * (y11 + y22);
    const double radius = std::hypot(0.5 * (y11 - y22), y12);
    const double least = mean - radius;
    const double greatest = mean + radius;
    if (least >= 0.0) {
        return;
    }
    const double scale = greatest > 0.0 ? greatest / (greatest - least) : 0.0;
    y11 = scale * (y11 - least);
    y12 = scale * y12;
    y22 = scale * (y22 - least);
}

} // namespace

MembraneHessian membrane_hessian(const PolarFactor& p, const MembraneStiffness& c) {
    const MembraneStress s = membrane_stress(p, c);
    const Mat2 Z = local_piola_stress(p, s);
    MembraneHessian h{.c = c};
    h.h1 = -Z(1, 0);
    h.h2 = Z(0, 1);
    h.h3 = 0.5 * (Z(0, 0) - Z(1, 1));
    h.spin = p.s11 * s.s11 + 2.0 * p.s12 * s.s12 + p.s22 * s.s22;

    // 2Y = (det S sigma + adj S sigma adj S) / (tr S det S)
    const double trace = p.s11 + p.s22;
    const double determinant = std::max(p.determinant, k_thinnest * trace * trace);
    if (trace > 0.0) {
        const double a11 = p.s22 * s.s11 - p.s12 * s.s12;
        const double a12 = p.s22 * s.s12 - p.s12 * s.s22;
        const double a21 = p.s11 * s.s12 - p.s12 * s.s11;
        const double a22 = p.s11 * s.s22 - p.s12 * s.s12;
        const double inverse = 1.0 / (trace * determinant);
        h.y11 = (determinant * s.s11 + a11 * p.s22 - a12 * p.s12) * inverse;
        h.y12 = (determinant * s.s12 + a12 * p.s11 - a11 * p.s12) * inverse;
        h.y22 = (determinant * s.s22 + a22 * p.s11 - a21 * p.s12) * inverse;
    }
    return h;
}

void project(MembraneHessian& h) {
    const double determinant = h.c.c11 * h.c.c22 - h.c.c12 * h.c.c12;
    const double coupling =
        (h.c.c22 * h.h1 * h.h1 - 2.0 * h.c.c12 * h.h1 * h.h2 + h.c.c11 * h.h2 * h.h2) /
            determinant +
        h.h3 * h.h3 / h.c.c33;
    h.spin = std::max(h.spin, coupling);
    clamp_negative(h.y11, h.y12, h.y22);
}

std::array<Mat3, 6> membrane_blocks(const MembraneHessian& hessian,
                                    const PolarFactor& polar,
                                    const RestTriangle& rest,
                                    double scale) {
    Form k{};
    add_pulled_back(k, strain_map(polar, rest.inverse_edges), hessian, scale * rest.area);
    return corner_blocks(k, hessian, scale * rest.area, polar, rest.inverse_edges);
}

ElementTerms<3> membrane_terms(const Corners& x,
                               const Corners& v,
                               const RestTriangle& rest,
                               const MembraneStiffness& c,
                               double damping_time,
                               SystemScales scales) {
    const Mat32 F = deformation_gradient(x, rest);
    const PolarFactor polar = polar_decompose(F);
    ElementTerms<3> terms;
    terms.energy = membrane_energy(polar, rest.area, c);
    terms.force = membrane_forces(F, polar, v, rest, c, damping_time);

    MembraneHessian hessian = membrane_hessian(polar, c);
    project(hessian);
    Form k{};
    add_pulled_back(k, strain_map(polar, rest.inverse_edges), hessian,
                    scales.stiffness * rest.area);
    if (damping_time > 0.0) {
        const MembraneHessian damping{.c = c};
        add_pulled_back(k, green_strain_map(polar, rest.inverse_edges), damping,
                        scales.damping * damping_time * rest.area);
    }
    terms.stiffness =
        corner_blocks(k, hessian, scales.stiffness * rest.area, polar, rest.inverse_edges);
    return terms;
}

MembraneElements::MembraneElements(const Cloth& cloth)
    : stiffness_(membrane_stiffness(cloth.params.fabric)),
      damping_time_(cloth.params.fabric.damping(1)), rest_(cloth.rest) {
    assert(cloth.rest.size() == cloth.triangles.size());
    set_triangles(cloth);
}

std::vector<Index> MembraneElements::remesh(const Cloth& cloth, const ClothChanges& changes) {
    rest_.resize(cloth.triangles.size());
    for (const Index t : changes.triangles) {
        rest_[at(t)] = cloth.rest[at(t)];
    }
    update_triangles(cloth, changes);
    return changes.triangles;
}

double MembraneElements::energy_of(std::size_t t, std::span<const Vec3> x) const {
    return membrane_energy(gather(t, x), rest_[t], stiffness_);
}

Corners
MembraneElements::force_of(std::size_t t, std::span<const Vec3> x, std::span<const Vec3> v) const {
    return membrane_forces(gather(t, x), gather(t, v), rest_[t], stiffness_, damping_time_);
}

ElementTerms<3> MembraneElements::terms_of(std::size_t t,
                                           std::span<const Vec3> x,
                                           std::span<const Vec3> v,
                                           SystemScales scales) const {
    return membrane_terms(gather(t, x), gather(t, v), rest_[t], stiffness_, damping_time_, scales);
}

} // namespace weft
