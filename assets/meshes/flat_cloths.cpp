#include <cmath>

#include "garments.h"
#include "isosurface.h"
#include "remesh.h"

namespace weft {

Garment make_tablecloth() {
    constexpr double k_radius = 0.7;       // m
    constexpr double k_edge_length = 0.03; // m
    const Field plane = [](const Vec3& p) { return p.y(); };
    const Field outside = [](const Vec3& p) { return std::hypot(p.x(), p.z()) - k_radius; };
    // A start much finer than the result, so that no trace of its grid is left.
    Patch patch = extract_isosurface(plane, {-0.75, -0.0117, -0.75}, {0.75, 0.01, 0.75}, 0.013);
    patch = clip(patch, outside, 1U);
    remesh(patch, plane, {outside}, [](const Vec3&) { return k_edge_length; });
    return {patch, project_flat(patch, Vec3::UnitX(), -Vec3::UnitZ())};
}

Garment make_flag() {
    constexpr double k_length = 1.5;        // m
    constexpr double k_height = 0.9;        // m
    constexpr double k_edge_length = 0.027; // m
    const Field plane = [](const Vec3& p) { return p.z(); };
    const std::vector<Field> sides{
        [](const Vec3& p) { return -p.x(); }, [](const Vec3& p) { return p.x() - k_length; },
        [](const Vec3& p) { return -p.y(); }, [](const Vec3& p) { return p.y() - k_height; }};
    Patch patch = extract_isosurface(plane, {-0.03, -0.03, -0.0057}, {1.54, 0.94, 0.008}, 0.012);
    for (size_t k = 0; k < sides.size(); ++k)
        patch = clip(patch, sides[k], 1U << k);
    remesh(patch, plane, sides, [](const Vec3&) { return k_edge_length; });
    return {patch, project_flat(patch, Vec3::UnitX(), Vec3::UnitY())};
}

} // namespace weft
