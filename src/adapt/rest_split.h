#pragma once

#include "state/refinement.h"
#include "state/rest_triangle.h"

/// Rest shapes of the triangles that refinement makes. They keep the material frame (weft, warp) of
/// what they are cut from; a flip gives both its triangles the mean of their frames.
namespace weft {

/// The rest triangle that a vertex was put into, as its record keeps it.
RestTriangle parent_rest(const InsertedVertex& record);
void set_parent_rest(InsertedVertex& record, const RestTriangle& rest);

/// Child k of a triangle cut at its barycentre c: (c, m_k, m_k+1).
RestTriangle split_rest(const RestTriangle& parent, std::uint32_t k);

/// Part k of (P, a, b) with its edge (a, b) cut at v1 and v2: 0: (P, v1, v2), 1: (v1, P, a),
/// 2: (v2, b, P).
RestTriangle trisect_rest(const RestTriangle& parent, std::uint32_t k);

/// Least share of their common area that a flip must leave to each of its triangles; where it
/// leaves less, the edge between them is cut in three instead, as a locked one. Meshes of regular
/// and of right-angled triangles never come near. On meshes with points moved at random the least
/// angle of all refinements was, of 14.8 (16.5) degrees in the base mesh: 1.3 (3.6) with 0.04, 2.7
/// (5.3) with 0.1, 4.3 (7.2) with 0.2, 4.3 (5.2) with 0.25. Below 0 a triangle would be turned
/// over.
inline constexpr double k_least_flip_share = 0.2;

/// A flip in the rest plane, with both triangles unfolded into it.
struct RestFlip {
    std::array<RestTriangle, 2> rest; ///< (P, a, Q) and (Q, b, P)
    double least_share;               ///< of their common area; below 0 one is turned over
};

/// Flips the edge opposite to corner 0 of (P, a, b) and (Q, b, a). Frames that agree to 1e-12 rad
/// are left alone, else each turns by half the angle between them. The common area is kept: where
/// the edge has two lengths (within k_same_length), by a scale as near to 1.
RestFlip flip_rest(const RestTriangle& first, const RestTriangle& second);

/// Angle (rad, in [-pi, pi]) by which a vector in the material coordinates of `second` has to turn
/// to be the same in those of `first`, when the triangles are laid into one plane at a common edge;
/// it is opposite to the corners given. So it is the angle from the frame of `first` to that of
/// `second`.
double frame_turn(const RestTriangle& first,
                  std::size_t first_corner,
                  const RestTriangle& second,
                  std::size_t second_corner);

} // namespace weft
