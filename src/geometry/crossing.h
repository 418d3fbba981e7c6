#pragma once

#include "base/eigen.h"
#include "geometry/triangle_mesh.h"

#include <optional>
#include <span>

namespace weft {

/// Does segment (p, q) meet triangle (a, b, c)? Exact; touching counts, a segment in the triangle's
/// plane does not (the sides of the other triangle of such a pair decide).
bool segment_meets_triangle(
    const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);

/// Corners of two triangles s and t that count as a vertex of the other, beside those that are.
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

/// Pairs of triangles of a mesh that cross, sorted, each with its lower number first. Neighbours
/// count only where they cross beyond the corners that they share. Exact (triangles_cross).
std::vector<std::array<Index, 2>> find_self_crossings(const TriangleMesh& mesh);

/// Direction (unit) in which an edge that pierces a face has to move against it so that the curve
/// in which the two surfaces cross grows shorter.
///
/// @param p, q   ends of the edge
/// @param apexes corners opposite to the edge of its one or two triangles
/// @param normal of the face, unit
/// Nothing when the edge lies in the face, or its two triangles pull evenly.
/// Source: Volino and Magnenat-Thalmann 2006, resolving surface collisions through intersection
/// contour minimization: sum over the triangles of R - 2 (E.R)/(E.N) N, R the unit direction of
/// the contour into the triangle.
std::optional<Vec3>
contour_gradient(const Vec3& p, const Vec3& q, std::span<const Vec3> apexes, const Vec3& normal);

/// Side of d of the plane through a, b, c: > 0 when a, b, c appear counter-clockwise seen from d's
/// opposite side (d below, as Shewchuk), < 0 above, 0 exactly on it. The sign is exact for all
/// finite doubles whose products neither overflow nor underflow.
/// Source: Shewchuk 1997, adaptive precision floating-point arithmetic (static filter, then exact).
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

} // namespace weft
