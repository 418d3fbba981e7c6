#pragma once

#include "frames/frame.h"

#include <functional>

namespace weft::test {

/// An upright square of cloth in the plane z = 0 around the origin, side in m, `cells` squares a
/// side; value(u, v) of every quantity, u and v in [0, 1].
FrameObject
square_cloth(double side, int cells, const std::function<double(double, double)>& value);

/// A tablecloth of 1.2 m with folds over a ball of 0.3 m at the origin, as a formula: a cap, then a
/// skirt whose folds deepen downwards. Stretch from 0.87 in the valleys to 1.14 at the top; the
/// other quantities run over their ranges alike.
FrameObject draped_cloth(int cells);

/// Obstacles around a centre, m.
FrameObject ball(double radius, int cells);
FrameObject box(const Vec3& centre, const Vec3& half_size);

} // namespace weft::test
