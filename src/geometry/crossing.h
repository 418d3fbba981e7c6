#pragma once

#include "base/eigen.h"

#include <span>

namespace weft {

/// Does segment (p, q) meet triangle (a, b, c)? Exact; touching counts, a segment in the triangle's
/// plane does not (the sides of the other triangle of such a pair decide).
bool segment_meets_triangle(
    const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);

/// Which corners of two triangles s and t count as a vertex of the other beside those that are.
struct SharedCorners {
    std::array<bool, 3> s{}, t{};
};

/// Do two triangles of a surface cross? A side of one that holds no vertex of the other must meet
/// the other; so neighbours cross only if they do beyond what they share. Exact.
///
/// @param x positions that the triangles index
bool triangles_cross(const Triangle& s,
                     const Triangle& t,
                     std::span<const Vec3> x,
                     const SharedCorners& shared = {});

/// A point that two crossing triangles share, to within rounding, m.
Vec3 crossing_place(const Triangle& s, const Triangle& t, std::span<const Vec3> x);

/// The ends of the segment that two crossing triangles share, to within rounding, m. They
/// must cross (asserted).
std::array<Vec3, 2> crossing_segment(const Triangle& s, const Triangle& t, std::span<const Vec3> x);

} // namespace weft
