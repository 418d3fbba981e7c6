#pragma once

#include "geometry/box_tree.h"
#include "state/world.h"

#include <span>
#include <vector>

namespace weft {

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
        BoxTree tree;                  ///< of its triangles there
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
