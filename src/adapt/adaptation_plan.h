#pragma once

#include "geometry/box_tree.h"
#include "state/cloth.h"
#include "state/world.h"

#include <span>
#include <vector>

namespace weft {

/// Refinement indicator of each triangle of a cloth: the greatest of its criteria (AdaptParams),
/// each divided by its limit. 1 is just fine enough, more is too coarse.
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
/// @param indicator      #T
void find_refinement_indicator(const Cloth& cloth,
                               std::span<const Vec3> x,
                               std::span<const Vec3> v,
                               std::span<const double> near_curvature,
                               std::vector<double>& indicator);

/// The triangles and vertices of a cloth that an adaptation is to change.
struct AdaptationPlan {
    std::vector<Index> refine; ///< triangles, the coarsest first
    std::vector<Index> remove; ///< vertices put in that nobody needs, the finest first

    bool empty() const { return refine.empty() && remove.empty(); }
};

/// Plans to refine the triangles whose indicator exceeds the cloth's tolerance (1, or more at its
/// budget of triangles) and to remove the vertices around which all indicators are below
/// k_coarsen_fraction of it, no sooner than k_dwell adaptations after the vertex came. Triangles
/// stay wider than k_least_width contact thicknesses: finer ones would fold within the thickness.
///
/// @param indicator  #T, of find_refinement_indicator
AdaptationPlan plan_adaptation(const Cloth& cloth, std::span<const double> indicator);

/// Fraction of the tolerance below which a vertex may go. Taking it out makes its triangles sqrt(3)
/// wider, so above 1/sqrt(3) they would be refined again at once.
inline constexpr double k_coarsen_fraction = 0.4;

/// Adaptations that a vertex stays at least. Fewer: folds that pass by make the mesh flicker; more:
/// triangles stand where folds have been.
inline constexpr Index k_dwell = 6;

/// Least width (square root of the area) of a triangle, in contact thicknesses.
inline constexpr double k_least_width = 2.0;

/// The cloth's tolerance after an adaptation: raised while its budget does not suffice, so that the
/// coarsest triangles of all win, and lowered again slowly.
double next_tolerance(double tolerance, bool is_short_of_triangles);

/// Mean curvature of the obstacles that cloth comes near to: cloth that will lie on them should be
/// fine enough before it does. Of obstacles that change their shape the curvature is that of the
/// shape they start with.
///
/// A ridge, an edge that turns outwards by more than k_ridge, has no curvature of its own: cloth
/// that lies over it turns by the ridge's angle within one triangle, however small. The vertices
/// of ridges count as flat otherwise; they say nothing of the faces between them.
class ObstacleCurvature {
public:
    /// Curvatures of all obstacles. O(their triangles).
    explicit ObstacleCurvature(const World& world);

    /// Curvature (1/m) of the obstacle nearest to each vertex of the cloth within its reach, at
    /// `time` (s); 0 where there is none. A vertex reaches as far as a triangle around it is wide,
    /// and as it goes in k_look_ahead.
    void find(const World& world, const Cloth& cloth, double time, std::vector<double>& curvature);

    /// Rad: more than the mesh of a body turns at nearly all its edges, less than a table does.
    static constexpr double k_ridge = 1.0;

    /// Time for which the way ahead is looked at, s: a frame, in which refinement gains the levels
    /// that it needs.
    static constexpr double k_look_ahead = 0.04;

private:
    struct Ridge {
        std::array<Index, 2> ends;
        double angle; ///< rad
    };
    struct Body {
        std::vector<double> curvature; ///< #V of the obstacle, 1/m
        std::vector<Vec3> places;      ///< #V, m, in the obstacle's own frame at `fitted`
        BoxTree tree;                  ///< its triangles there
        std::vector<Ridge> ridges;
        BoxTree ridge_tree;
        double fitted = 0.0; ///< s
    };

    void fit(const Obstacle& obstacle, double time, Body& body) const;
    static void find_ridges(const Obstacle& obstacle, Body& body);
    static double nearest_ridge(const Body& body, const Vec3& p, double reach);
    static double nearest(const Obstacle& obstacle, const Body& body, const Vec3& p, double reach);

    std::vector<Body> bodies_; ///< as World::obstacles
};

} // namespace weft
