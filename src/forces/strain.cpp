#include "forces/strain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {

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

} // namespace weft
