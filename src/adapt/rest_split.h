#pragma once

#include "state/cloth.h"
#include "state/refinement.h"
#include "state/rest_shape.h"

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

/// Least fraction of their common area that a flip must leave to each of its triangles; where it
/// leaves less, the edge between them is cut in three instead, as a locked one, which two levels
/// later gives ninths of both triangles' own shape. Flips do so only where both are halves of a
/// parallelogram (fraction 1/2): elsewhere each level skews the next. At 1/3 (right-angled
/// triangles mirrored at a leg, as in grids with alternating diagonals) least angles fell with the
/// level: 18, 15, 12.5, 11.4, 8.4, 8.1, 5.6 degrees, and on irregular meshes alike; above it they
/// keep: 18.4 degrees on such grids at any level, and a third to a half of the imported mesh's
/// least angle on irregular ones. The price: an edge not flipped leaves odd levels half done, with
/// bending up to 1.4 times too stiff on such grids (1.1 on irregular ones) where 1.1 were possible;
/// even levels are exact.
inline constexpr double k_least_flip_fraction = 0.36;

/// A flip in the rest plane, with both triangles unfolded into it.
struct RestFlip {
    std::array<RestTriangle, 2> rest; ///< (P, a, Q) and (Q, b, P)
    double least_fraction; ///< lesser area over their common one; < 0: one is turned over
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

/// Least angle of a cloth's rest triangles, rad; pi / 3 without triangles.
double least_rest_angle(const Cloth& cloth);

/// Least angle (rad) of all rest triangles that refinement up to `levels` can bring about, whatever
/// is refined and removed and in what order, and whatever flips have to wait: what the imported
/// mesh itself allows. Of equilateral triangles 30 degrees, of right isosceles ones atan(1/3) =
/// 18.43, of others about half of their own least angle; locked edges and frozen triangles count.
///
/// A triangle of any such mesh depends on the vertices that it rests on alone, so that all of them
/// occur while the whole mesh is refined. That is done to a copy: time and memory are 3^levels
/// times those of the imported mesh.
/// @param cloth   adaptive (make_refinement), in any state
/// @param levels  0..k_most_levels
double least_refined_angle(const Cloth& cloth, Index levels);

} // namespace weft
