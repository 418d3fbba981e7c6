#pragma once

#include "forces/membrane.h"

namespace weft {

/// How one triangle is deformed, for output.
struct StrainMeasures {
    double stretch_max, stretch_min; ///< principal stretches; 1 = rest
    double strain_weft, strain_warp; ///< change of length along the yarns, 0 = rest
    double shear_deg;                ///< 90 degrees minus the angle between the yarns
    double tension;                  ///< greatest principal stress, N/m; negative: compressed
};

/// Measures of a triangle with corners x (m). A yarn of no length has no shear angle (0).
StrainMeasures
strain_measures(const Corners& x, const RestTriangle& rest, const MembraneStiffness& c);

} // namespace weft
