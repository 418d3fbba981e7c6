#pragma once

#include "patch.h"

namespace weft {

inline constexpr double k_skirt_waist = 1.065; ///< height of the waistband, m
inline constexpr double k_skirt_hem = 0.500;   ///< m

/// The skirt's surface as a radius around a vertical axis, over angle and height: the body and a
/// margin down to the hips, then a flare.
class SkirtShape {
public:
    SkirtShape();

    /// Distance from the axis beyond the skirt, m; negative inside. Constant above and below it.
    double operator()(const Vec3& position) const;

private:
    double& radius(int row, int column);
    void wrap_body();
    void hang_from_hips();
    void smooth();

    std::vector<double> radii_;   ///< m, rows from the hem up, columns from front to back
    std::vector<double> allowed_; ///< least radii that clear the body
};

} // namespace weft
