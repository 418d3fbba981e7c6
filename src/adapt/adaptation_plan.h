#pragma once

#include "state/cloth.h"

#include <span>
#include <vector>

namespace weft {

/// What an adaptation is to do with a cloth.
struct AdaptationPlan {
    std::vector<Index> refine; ///< triangles, the coarsest first
    std::vector<Index> remove; ///< vertices put in that nobody needs, the finest first

    bool empty() const { return refine.empty() && remove.empty(); }
};

/// Refines triangles that are coarser than the cloth's tolerance (1, or more at its budget of
/// triangles) and coarsens where all around a vertex are much finer than it, no sooner than
/// k_dwell adaptations after the vertex came. Triangles stay wider than k_least_width contact
/// thicknesses: finer ones would fold within the thickness.
///
/// @param coarseness  #T, see coarseness.h
AdaptationPlan plan_adaptation(const Cloth& cloth, std::span<const double> coarseness);

/// Share of the tolerance below which a vertex may go. Taking it out makes its triangles sqrt(3)
/// wider, so above 1/sqrt(3) they would be refined again at once.
inline constexpr double k_coarsen_share = 0.4;

/// Adaptations that a vertex stays at least. Fewer: folds that pass by make the mesh flicker; more:
/// triangles stand where folds have been.
inline constexpr Index k_dwell = 6;

/// Least width (square root of the area) of a triangle, in contact thicknesses.
inline constexpr double k_least_width = 2.0;

/// The cloth's tolerance after an adaptation: raised while its budget does not suffice, so that the
/// coarsest triangles of all win, and lowered again slowly.
double next_tolerance(double tolerance, bool is_short_of_triangles);

} // namespace weft
