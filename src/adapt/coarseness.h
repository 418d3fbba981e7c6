#pragma once

#include "state/cloth.h"

#include <span>
#include <vector>

namespace weft {

/// How much too coarse each triangle of a cloth is for what happens there: the greatest of what its
/// criteria (AdaptParams) find, each divided by its limit; 1 is just fine enough.
///
/// - curvature: the greater mean curvature |H| at its corners, times its size h, the square root of
///   its rest area: about half the angle by which the cloth turns across it.
/// - contact: the same with the curvature of the obstacle that a corner comes near.
/// - compression: 1 - the lesser principal stretch: cloth that cannot buckle yet on this mesh. The
///   limit is not below the compression that buckles waves of two edges: what the mesh can show
///   needs no finer one, and cloth that has buckled keeps no more.
/// - velocity: the greatest difference of velocity between its corners, m/s.
///
/// Source: Bender and Deul 2013 (mean curvature); Narain et al. 2012 (the others).
///
/// @param x, v            #V of the cloth, m and m/s
/// @param near_curvature  #V of the cloth: of the obstacle nearby, 1/m; 0: none; empty: nowhere
/// @param coarseness      #T
void find_coarseness(const Cloth& cloth,
                     std::span<const Vec3> x,
                     std::span<const Vec3> v,
                     std::span<const double> near_curvature,
                     std::vector<double>& coarseness);

} // namespace weft
