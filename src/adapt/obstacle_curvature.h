#pragma once

#include "geometry/box_tree.h"
#include "state/world.h"

#include <span>
#include <vector>

namespace weft {

/// Mean curvature of the obstacles that cloth comes near to: cloth that will lie on them should be
/// fine enough before it does. Of obstacles that change their shape the curvature is that of the
/// shape they start with.
class ObstacleCurvature {
public:
    /// Curvatures of all obstacles. O(their triangles).
    explicit ObstacleCurvature(const World& world);

    /// Curvature (1/m) of the obstacle nearest to each vertex of the cloth within its reach, at
    /// `time` (s); 0 where there is none. A vertex reaches as far as a triangle around it is wide,
    /// and as it goes in k_look_ahead.
    void find(const World& world, const Cloth& cloth, double time, std::vector<double>& curvature);

    /// Time for which the way ahead is looked at, s: a frame, in which refinement gains the levels
    /// that it needs.
    static constexpr double k_look_ahead = 0.04;

private:
    struct Body {
        std::vector<double> curvature; ///< #V of the obstacle, 1/m
        std::vector<Vec3> places;      ///< #V, m, in the obstacle's own frame at `fitted`
        BoxTree tree;                  ///< of its triangles there
        double fitted = 0.0;           ///< s
    };

    void fit(const Obstacle& obstacle, double time, Body& body) const;
    static double nearest(const Obstacle& obstacle, const Body& body, const Vec3& p, double reach);

    std::vector<Body> bodies_; ///< as World::obstacles
};

} // namespace weft
