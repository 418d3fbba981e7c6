#pragma once

#include "geometry/separation.h"

#include <optional>

namespace weft {

/// How near the two sides of a pair may come: the lesser of a distance and a fraction of the
/// distance they start at, so that a pair that starts too near may stay where it is.
struct ApproachLimit {
    double distance;       ///< m, >= 0
    double fraction = 0.5; ///< of the start distance, [0, 1)
};

/// Conservative continuous detection: the four points move linearly, x + t * displacement. Returns
/// nothing only if the sides stay further apart than the limit allows for all t in [0, 1];
/// otherwise a time up to which they do, near the first time that the gap above the limit falls to
/// a tenth of what it was. 0 for sides that touch at the start.
///
/// Source: additive continuous detection, Li et al. 2021 (C-IPC), section 4.4, with a longer step
/// where the direction between the closest points separates the sides.
std::optional<double> time_of_impact(PairKind kind,
                                     const PairPoints& start,
                                     const PairPoints& displacement,
                                     const ApproachLimit& limit);

} // namespace weft
