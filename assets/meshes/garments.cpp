#include "garments.h"

#include <algorithm>
#include <cmath>

#include "body_field.h"
#include "isosurface.h"
#include "loft.h"
#include "remesh.h"
#include "skirt_shape.h"

// Each garment is the zero set of a field that keeps clear of the body's, cut open by further
// fields. Only the half x > 0 is meshed; the other half is its mirror image.

namespace weft {
namespace {

constexpr unsigned k_mirror_curve = 1U; // bit of the border on x = 0, always the first limit

double minus_x(const Vec3& p) {
    return -p.x();
}

Field above(double height) {
    return [height](const Vec3& p) { return p.y() - height; };
}

Field below(double height) {
    return [height](const Vec3& p) { return height - p.y(); };
}

/// Where a garment is cut: bit k of the curves is cut k.
struct Cutting {
    std::vector<Field> cuts;  ///< positive where there is no cloth; the first is minus_x
    std::vector<Field> seams; ///< seam k divides panels n (negative) and n + 2^k
    Vec3 box_min;
    Vec3 box_max;
};

Patch cut_from_field(const Field& field, const Cutting& cutting, double edge_length) {
    Patch patch = extract_isosurface(field, cutting.box_min, cutting.box_max, 0.010);
    std::vector<Field> limits;
    unsigned curve = 1U;
    for (const Field& cut : cutting.cuts) {
        patch = clip(patch, cut, curve);
        limits.push_back(cut);
        curve <<= 1;
    }
    patch = largest_part(patch);
    for (size_t k = 0; k < cutting.seams.size(); ++k) {
        patch = divide(patch, cutting.seams[k], curve, 1 << k);
        limits.push_back(cutting.seams[k]);
        curve <<= 1;
    }
    remesh(patch, field, limits, [edge_length](const Vec3&) { return edge_length; });
    return mirror_x(patch, k_mirror_curve);
}

const SkirtShape& skirt_shape() {
    static const SkirtShape shape;
    return shape;
}

/// The round neck: above a saddle that is low in front and high over the shoulders, so that it
/// meets neck, chest and shoulders at steep angles. Positive above.
double neck_opening(const Vec3& p) {
    const double z = p.z() + 0.015;
    return p.y() - (1.421 - 0.38 * z + 5.9 * p.x() * p.x());
}

/// Beyond the end of the sleeve. Positive there and on the rest of the arm.
double sleeve_opening(const Vec3& p) {
    static const Vec3 end(0.268, 1.248, -0.018);
    const double beyond = (p - end).dot(upper_arm_direction());
    const double arm_side = p.x() - 0.175 - 0.5 * (1.25 - p.y());
    return std::min(beyond, arm_side);
}

double sleeve(const Vec3& p) {
    static const Loft loft({{{0.120, 1.400, -0.018}, 0.044, 0.055},
                            {{0.180, 1.360, -0.018}, 0.060, 0.061},
                            {{0.230, 1.297, -0.018}, 0.062, 0.064},
                            {{0.330, 1.170, -0.018}, 0.067, 0.068}},
                           {.end_cap = 0.03});
    return loft.distance(p);
}

/// Hangs from bust and shoulder blades without following the waist.
double tunic(const Vec3& p) {
    static const Loft loft({{{0, 0.840, -0.006}, 0.192, 0.140},
                            {{0, 0.930, -0.005}, 0.185, 0.135},
                            {{0, 1.000, 0.000}, 0.171, 0.123},
                            {{0, 1.080, 0.005}, 0.156, 0.113},
                            {{0, 1.160, 0.005}, 0.149, 0.110},
                            {{0, 1.240, 0.000}, 0.149, 0.108},
                            {{0, 1.310, -0.010}, 0.147, 0.099},
                            {{0, 1.365, -0.018}, 0.120, 0.080}},
                           {.exponent = 2.2, .start_cap = 0.02, .end_cap = 0.03});
    return loft.distance(p);
}

double tshirt_field(const Vec3& p) {
    constexpr double k_over_body = 0.008;  // m
    constexpr double k_over_skirt = 0.011; // m, more than two thicknesses of cloth
    const double over_skirt = std::max(skirt_shape()(p) - k_over_skirt, p.y() - 1.04);
    double d = smooth_union(body_field(p) - k_over_body, tunic(p), 0.04);
    d = smooth_union(d, over_skirt, 0.02);
    d = smooth_union(d, sleeve(p), 0.05);
    return smooth_union(d, sleeve({-p.x(), p.y(), p.z()}), 0.05);
}

double side_seam(const Vec3& p) {
    return -0.018 - p.z();
}

/// Between body and sleeve. Positive on the sleeve.
double armhole_seam(const Vec3& p) {
    return p.x() - std::max(0.163, 0.163 + 0.5 * (1.22 - p.y()));
}

/// A hole for the arm, round as seen from the front, and all of the arm beyond. Positive there.
double dress_armhole(const Vec3& p) {
    const Vec3 offset(p.x() - 0.203, p.y() - 1.368, 0.0);
    const double along = std::max(offset.dot(upper_arm_direction()), 0.0);
    return 0.091 - (offset - along * upper_arm_direction()).norm();
}

double dress_neck(const Vec3& p) {
    const double z = p.z() + 0.015;
    return p.y() - (1.400 - 0.55 * z + 6.0 * p.x() * p.x());
}

/// Spans the hollow between the breasts and the back, fitted at the waist.
double bodice(const Vec3& p) {
    static const Loft loft({{{0, 1.060, 0.006}, 0.122, 0.090},
                            {{0, 1.100, 0.007}, 0.1225, 0.090},
                            {{0, 1.150, 0.007}, 0.127, 0.094},
                            {{0, 1.210, 0.006}, 0.139, 0.105},
                            {{0, 1.265, 0.002}, 0.149, 0.115},
                            {{0, 1.320, -0.010}, 0.147, 0.103},
                            {{0, 1.370, -0.019}, 0.120, 0.083}},
                           {.exponent = 2.2, .start_cap = 0.02, .end_cap = 0.03});
    return loft.distance(p);
}

double dress_field(const Vec3& p) {
    const double fitted = smooth_union(body_field(p) - 0.008, bodice(p), 0.03);
    return smooth_union(fitted, std::max(skirt_shape()(p), p.y() - k_skirt_waist), 0.03);
}

} // namespace

Garment make_skirt() {
    const Field shape = [](const Vec3& p) { return skirt_shape()(p); };
    const Patch patch = cut_from_field(shape,
                                       {.cuts = {minus_x, above(k_skirt_waist), below(k_skirt_hem)},
                                        .seams = {},
                                        .box_min = {-0.0057, 0.48, -0.42},
                                        .box_max = {0.42, 1.09, 0.42}},
                                       0.0215);
    return {patch, flatten(cut_open_behind(patch, k_mirror_curve))};
}

Garment make_tshirt() {
    const Patch patch =
        cut_from_field(tshirt_field,
                       {.cuts = {minus_x, below(0.935), neck_opening, sleeve_opening},
                        .seams = {side_seam, armhole_seam},
                        .box_min = {-0.0057, 0.91, -0.20},
                        .box_max = {0.38, 1.52, 0.20}},
                       0.0215);
    return {patch, flatten(patch)};
}

Garment make_dress() {
    const Patch patch =
        cut_from_field(dress_field,
                       {.cuts = {minus_x, below(k_skirt_hem), dress_neck, dress_armhole},
                        .seams = {side_seam},
                        .box_min = {-0.0057, 0.48, -0.42},
                        .box_max = {0.42, 1.52, 0.42}},
                       0.0225);
    return {patch, flatten(patch)};
}

} // namespace weft
