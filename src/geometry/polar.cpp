#include "geometry/polar.h"

#include <cmath>

namespace weft {

namespace {

/// Sine of the angle between the columns below which their cross product has lost its direction.
constexpr double k_collapsed = 1e-14;

/// A unit vector normal to v.
Vec3 any_normal(const Vec3& v) {
    int least = 0;
    v.cwiseAbs().minCoeff(&least);
    return v.cross(Vec3::Unit(least)).normalized();
}

} // namespace

PolarFactor polar_decompose(const Mat32& F) {
    const Vec3 f1 = F.col(0);
    const Vec3 f2 = F.col(1);
    const double c11 = f1.squaredNorm();
    const double c22 = f2.squaredNorm();
    const double c12 = f1.dot(f2);
    const Vec3 cross = f1.cross(f2);
    PolarFactor polar;
    polar.determinant = cross.norm();
    const double trace_squared = c11 + c22 + 2.0 * polar.determinant;
    if (!(trace_squared > 1e-200)) {
        polar.R << 1, 0, 0, 1, 0, 0;
        polar.normal = Vec3::UnitZ();
        polar.s11 = polar.s12 = polar.s22 = polar.determinant = 0.0;
        return polar;
    }
    polar.normal = polar.determinant > k_collapsed * trace_squared
                       ? Vec3(cross / polar.determinant)
                       : any_normal(c11 > c22 ? f1 : f2);
    const double inverse_trace = 1.0 / std::sqrt(trace_squared);
    polar.R.col(0) = (f1 + f2.cross(polar.normal)) * inverse_trace;
    polar.R.col(1) = (f2 + polar.normal.cross(f1)) * inverse_trace;
    polar.s11 = (c11 + polar.determinant) * inverse_trace;
    polar.s12 = c12 * inverse_trace;
    polar.s22 = (c22 + polar.determinant) * inverse_trace;
    return polar;
}

Vec2 principal_stretches(const Mat32& F) {
    const double c11 = F.col(0).squaredNorm();
    const double c22 = F.col(1).squaredNorm();
    const double c12 = F.col(0).dot(F.col(1));
    const double determinant = F.col(0).cross(F.col(1)).norm();
    const double sum = std::sqrt(c11 + c22 + 2.0 * determinant);
    if (!(sum > 0.0)) {
        return Vec2::Zero();
    }
    // s1^2 - s2^2 = |(c11 - c22, 2 c12)|; the small stretch from the determinant keeps its digits
    const double difference = std::hypot(c11 - c22, 2.0 * c12) / sum;
    const double greatest = 0.5 * (sum + difference);
    return {greatest, determinant / greatest};
}

} // namespace weft
