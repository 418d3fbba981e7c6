#include "rabbit.h"

#include <algorithm>
#include <cmath>

#include "isosurface.h"
#include "loft.h"
#include "remesh.h"

// The rabbit is made of ellipsoids and lofted ears joined by smooth unions. All numbers are metres.

namespace weft {
namespace {

double body(const Vec3& p) {
    const double trunk = ellipsoid_distance(p, {0.0, 0.105, -0.020}, {0.080, 0.090, 0.105});
    const double chest = ellipsoid_distance(p, {0.0, 0.125, 0.050}, {0.060, 0.075, 0.055});
    const double haunch = ellipsoid_distance(p, {0.058, 0.068, -0.055}, {0.042, 0.060, 0.064});
    const double belly = ellipsoid_distance(p, {0.0, 0.052, 0.020}, {0.072, 0.047, 0.092});
    const double tail = ellipsoid_distance(p, {0.0, 0.075, -0.137}, {0.028, 0.027, 0.025});
    const double trunk_and_chest = smooth_union(trunk, chest, 0.05);
    const double torso = smooth_union(trunk_and_chest, belly, 0.03);
    return smooth_union(smooth_union(torso, haunch, 0.03), tail, 0.012);
}

double head(const Vec3& p) {
    const double skull = ellipsoid_distance(p, {0.0, 0.215, 0.070}, {0.047, 0.050, 0.058});
    const double cheek = ellipsoid_distance(p, {0.020, 0.198, 0.095}, {0.028, 0.027, 0.030});
    const double muzzle = ellipsoid_distance(p, {0.0, 0.202, 0.122}, {0.022, 0.020, 0.020});
    return smooth_union(smooth_union(skull, cheek, 0.025), muzzle, 0.02);
}

double ear(const Vec3& p) {
    static const Loft loft({{{0.018, 0.240, 0.058}, 0.013, 0.012},
                            {{0.024, 0.270, 0.046}, 0.020, 0.012},
                            {{0.031, 0.305, 0.034}, 0.023, 0.011},
                            {{0.037, 0.335, 0.025}, 0.018, 0.010},
                            {{0.040, 0.352, 0.020}, 0.011, 0.009}},
                           {.start_cap = 0.01, .end_cap = 0.008});
    return loft.distance(p);
}

double feet(const Vec3& p) {
    const double fore = ellipsoid_distance(p, {0.034, 0.024, 0.082}, {0.021, 0.024, 0.036});
    const double foreleg = ellipsoid_distance(p, {0.036, 0.065, 0.066}, {0.022, 0.055, 0.024});
    const double hind = ellipsoid_distance(p, {0.066, 0.021, 0.005}, {0.024, 0.021, 0.058});
    return std::min(smooth_union(fore, foreleg, 0.02), hind);
}

/// Symmetric in x: asked on one side.
double rabbit_field(const Vec3& position) {
    const Vec3 p(std::abs(position.x()), position.y(), position.z());
    const double torso = smooth_union(body(p), head(p), 0.03);
    return smooth_union(smooth_union(torso, ear(p), 0.012), feet(p), 0.018);
}

} // namespace

ObjMesh make_rabbit() {
    const Field mirror = [](const Vec3& p) { return -p.x(); };
    const Field edge_length = [](const Vec3& p) {
        constexpr double k_body = 0.0110;
        constexpr double k_ear = 0.0085;
        return p.y() > 0.25 ? k_ear : k_body;
    };
    Patch patch =
        extract_isosurface(rabbit_field, {-0.0023, -0.02, -0.19}, {0.13, 0.40, 0.17}, 0.004);
    patch = largest_part(clip(patch, mirror, 1U));
    remesh(patch, rabbit_field, {mirror}, edge_length);
    patch = mirror_x(patch, 1U);
    return {patch.vertices, patch.triangles, {}, {}};
}

} // namespace weft
