#pragma once

#include "collide/tangle.h"

namespace weft {

/// A wish on up to four vertices of a tangle: normal . (sum of weight times position) >= least.
struct Push {
    std::array<Index, 4> vertices; ///< k_no_index: none
    std::array<double, 4> weights;
    Vec3 normal; ///< unit
    double least;
};

/// Moves the vertices of a push the shortest way, each by its mobility, to where it is met; by at
/// most `greatest` (m).
void apply(const Push& push, double greatest, Tangle& tangle);

/// What keeps moving cloth that does not cross apart, or from what stands, by the room: vertices
/// against faces and edges against edges along their shortest connection.
void find_room_pushes(const Tangle& tangle,
                      std::span<const NearPair> pairs,
                      double room,
                      std::vector<Push>& pushes);

/// What shortens the curves in which moving cloth crosses itself or other moving cloth: each edge
/// that pierces a face moves against it by `step` (m).
void find_contour_pushes(const Tangle& tangle,
                         std::span<const NearPair> pairs,
                         double step,
                         std::vector<Push>& pushes);

} // namespace weft
