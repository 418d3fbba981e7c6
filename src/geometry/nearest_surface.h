#pragma once

#include "geometry/box_tree.h"
#include "geometry/triangle_mesh.h"

#include <optional>
#include <span>
#include <vector>

namespace weft {

/// The point of a surface nearest to another, and on which side of it that one lies.
struct SurfacePoint {
    Vec3 place;          ///< m
    Vec3 normal;         ///< unit, away from the surface's inner side
    double height;       ///< distance of the point asked for, m; negative behind the surface
    bool is_on_boundary; ///< nearest to the rim of an open surface, where no side is its own
};

/// Nearest points of a surface with their side. It may be open, cross itself and come in many
/// parts: the side is that of the nearest part alone.
/// Source: Baerentzen and Aanaes 2005 (angle-weighted normals at vertices and edges).
class NearestSurface {
public:
    /// @param triangles wound counter-clockwise seen from outside; those without area are left out
    NearestSurface(std::vector<Vec3> positions, std::span<const Triangle> triangles);

    /// The nearest point to p that is nearer than `reach` (m).
    std::optional<SurfacePoint> find(const Vec3& p, double reach) const;

    /// Way (m) from p along a unit direction to where the ray first goes out through the surface,
    /// its inner side before; nothing within `reach`.
    std::optional<double> first_hit(const Vec3& p, const Vec3& direction, double reach) const;

    /// Mean normal of the surface around a vertex; zero for one in no triangle.
    const Vec3& vertex_normal(Index v) const { return vertex_normals_[at(v)]; }

private:
    Vec3 normal_at(Index triangle, const Vec3& weights, bool& is_on_boundary) const;

    std::vector<Vec3> positions_;
    std::vector<Triangle> triangles_;
    EdgeTopology topology_;
    std::vector<Vec3> face_normals_, vertex_normals_;
    std::vector<char> on_boundary_; ///< #V
    BoxTree tree_;
};

} // namespace weft
