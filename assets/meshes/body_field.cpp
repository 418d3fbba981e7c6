#include "body_field.h"

#include <algorithm>
#include <cmath>

#include "loft.h"

// The figure is made of lofts (trunk, shoulders, neck, head, legs, feet, arms, hands) joined by
// smooth unions; ellipsoids add what the sections cannot say. All numbers below are metres. Girths:
// bust 0.86, waist 0.63, hips 0.91, like a shop mannequin.

namespace weft {
namespace {

Vec3 mirrored(const Vec3& p) {
    return {-p.x(), p.y(), p.z()};
}

double trunk(const Vec3& p) {
    static const Loft loft({{{0, 0.845, -0.010}, 0.090, 0.046},
                            {{0, 0.885, -0.010}, 0.134, 0.072},
                            {{0, 0.930, -0.008}, 0.152, 0.095},
                            {{0, 0.970, -0.003}, 0.152, 0.098},
                            {{0, 1.025, 0.004}, 0.132, 0.089},
                            {{0, 1.080, 0.007}, 0.1145, 0.080},
                            {{0, 1.135, 0.004}, 0.1165, 0.082},
                            {{0, 1.200, -0.003}, 0.129, 0.089},
                            {{0, 1.270, -0.010}, 0.141, 0.094},
                            {{0, 1.330, -0.017}, 0.141, 0.088},
                            {{0, 1.375, -0.021}, 0.119, 0.075},
                            {{0, 1.410, -0.022}, 0.087, 0.062},
                            {{0, 1.445, -0.021}, 0.055, 0.050},
                            {{0, 1.490, -0.014}, 0.036, 0.040}},
                           {.exponent = 2.2, .start_cap = 0.04, .end_cap = 0.02});
    return loft.distance(p);
}

double shoulders(const Vec3& p) {
    static const Loft loft({{{-0.160, 1.386, -0.018}, 0.041, 0.046},
                            {{-0.120, 1.409, -0.022}, 0.040, 0.045},
                            {{-0.060, 1.428, -0.023}, 0.038, 0.045},
                            {{0.000, 1.434, -0.023}, 0.038, 0.045},
                            {{0.060, 1.428, -0.023}, 0.038, 0.045},
                            {{0.120, 1.409, -0.022}, 0.040, 0.045},
                            {{0.160, 1.386, -0.018}, 0.041, 0.046}},
                           {.side_axis = Vec3::UnitY(), .start_cap = 0.04, .end_cap = 0.04});
    return loft.distance(p);
}

double neck(const Vec3& p) {
    static const Loft loft({{{0, 1.420, -0.022}, 0.056, 0.054},
                            {{0, 1.470, -0.015}, 0.051, 0.051},
                            {{0, 1.520, -0.004}, 0.047, 0.049},
                            {{0, 1.580, 0.006}, 0.047, 0.050},
                            {{0, 1.640, 0.010}, 0.047, 0.050}},
                           {});
    return loft.distance(p);
}

/// Cranium and jaw; no face, like a shop mannequin.
double head(const Vec3& p) {
    const double cranium = ellipsoid_distance(p, {0, 1.670, -0.004}, {0.0715, 0.088, 0.089});
    const double jaw = ellipsoid_distance(p, {0, 1.612, 0.036}, {0.0500, 0.074, 0.054});
    return smooth_union(cranium, jaw, 0.09);
}

/// The leg on the side x > 0 down to the ankle.
double leg(const Vec3& p) {
    static const Loft loft({{{0.076, 1.000, 0.000}, 0.040, 0.046},
                            {{0.079, 0.925, -0.004}, 0.067, 0.073},
                            {{0.083, 0.855, -0.005}, 0.0755, 0.087},
                            {{0.087, 0.780, -0.001}, 0.0720, 0.085},
                            {{0.091, 0.690, 0.005}, 0.0630, 0.075},
                            {{0.096, 0.590, 0.009}, 0.0535, 0.062},
                            {{0.099, 0.505, 0.008}, 0.0460, 0.052},
                            {{0.101, 0.445, 0.000}, 0.0440, 0.049},
                            {{0.104, 0.370, -0.012}, 0.0475, 0.054},
                            {{0.106, 0.300, -0.016}, 0.0440, 0.050},
                            {{0.109, 0.200, -0.016}, 0.0335, 0.038},
                            {{0.112, 0.120, -0.016}, 0.0270, 0.033},
                            {{0.113, 0.080, -0.015}, 0.0285, 0.036},
                            {{0.114, 0.045, -0.012}, 0.0305, 0.039}},
                           {.start_cap = 0.03});
    return loft.distance(p);
}

double foot(const Vec3& p) {
    static const Loft loft({{{0.114, 0.033, -0.050}, 0.023, 0.027},
                            {{0.114, 0.038, -0.025}, 0.031, 0.038},
                            {{0.116, 0.040, 0.020}, 0.032, 0.040},
                            {{0.121, 0.030, 0.065}, 0.036, 0.034},
                            {{0.127, 0.021, 0.107}, 0.042, 0.026},
                            {{0.130, 0.015, 0.140}, 0.038, 0.0195},
                            {{0.129, 0.013, 0.162}, 0.028, 0.0160}},
                           {.exponent = 2.3, .start_cap = 0.018, .end_cap = 0.016});
    // The plane makes the sole flat.
    return -smooth_union(-loft.distance(p), p.y(), 0.012);
}

/// The arm on the side x > 0 down to the wrist.
double arm(const Vec3& p) {
    static const Loft loft({{{0.158, 1.380, -0.018}, 0.047, 0.047},
                            {{0.191, 1.346, -0.018}, 0.0495, 0.0470},
                            {{0.234, 1.291, -0.018}, 0.0430, 0.0425},
                            {{0.290, 1.224, -0.019}, 0.0365, 0.037},
                            {{0.340, 1.160, -0.019}, 0.0325, 0.033},
                            {{0.370, 1.122, -0.015}, 0.0335, 0.0355},
                            {{0.410, 1.071, -0.006}, 0.031, 0.033},
                            {{0.455, 1.013, 0.006}, 0.0245, 0.027},
                            {{0.490, 0.968, 0.016}, 0.020, 0.025}},
                           {.end_cap = 0.015});
    return loft.distance(p);
}

/// A mitten with its palm to the thigh; the fingers are one piece, the thumb another.
double hand(const Vec3& p) {
    static const Loft palm({{{0.482, 0.978, 0.014}, 0.025, 0.0195},
                            {{0.503, 0.951, 0.020}, 0.029, 0.0195},
                            {{0.526, 0.920, 0.026}, 0.0375, 0.0185},
                            {{0.546, 0.890, 0.031}, 0.0390, 0.0165},
                            {{0.562, 0.862, 0.036}, 0.0355, 0.0150},
                            {{0.576, 0.832, 0.040}, 0.0305, 0.0135},
                            {{0.584, 0.808, 0.042}, 0.0235, 0.0120}},
                           {.side_axis = Vec3::UnitZ(), .exponent = 2.2, .end_cap = 0.016});
    static const Loft thumb({{{0.510, 0.942, 0.036}, 0.0165, 0.0165},
                             {{0.520, 0.917, 0.060}, 0.0150, 0.0145},
                             {{0.530, 0.888, 0.075}, 0.0125, 0.0120}},
                            {.side_axis = Vec3::UnitZ(), .end_cap = 0.014});
    return smooth_union(palm.distance(p), thumb.distance(p), 0.016);
}

double arm_and_hand(const Vec3& p) {
    return smooth_union(arm(p), hand(p), 0.014);
}

double leg_and_foot(const Vec3& p) {
    return smooth_union(leg(p), foot(p), 0.030);
}

/// The figure so far with bust and seat on the side x > 0.
double rounded_forms(const Vec3& p, double figure_distance) {
    const double bust = ellipsoid_distance(p, {0.066, 1.262, 0.058}, {0.057, 0.060, 0.052});
    const double seat = ellipsoid_distance(p, {0.066, 0.892, -0.066}, {0.074, 0.078, 0.058});
    return smooth_union(smooth_union(figure_distance, bust, 0.055), seat, 0.06);
}

} // namespace

double body_field(const Vec3& position) {
    const Vec3 image = mirrored(position);
    double d = smooth_union(trunk(position), shoulders(position), 0.07);
    d = smooth_union(d, neck(position), 0.07);
    d = smooth_union(d, head(position), 0.035);
    // The wide blends round armpit, deltoid and groin.
    d = smooth_union(d, arm_and_hand(position), 0.05);
    d = smooth_union(d, arm_and_hand(image), 0.05);
    d = smooth_union(d, smooth_union(leg_and_foot(position), leg_and_foot(image), 0.03), 0.09);
    return rounded_forms(image, rounded_forms(position, d));
}

double body_distance(const Vec3& position) {
    constexpr double k_near = 0.03; // m; farther off the field jumps between parts of a loft
    const double value = body_field(position);
    return std::abs(value) < k_near ? value / gradient(body_field, position).norm() : value;
}

Vec3 upper_arm_direction() {
    return Vec3(0.180, -0.228, 0.0).normalized();
}

} // namespace weft
