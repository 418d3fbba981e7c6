#pragma once

#include "geometry/triangle_mesh.h"

#include <span>
#include <vector>

namespace weft {

/// Solid angle at p of triangle (a, b, c) over 4 pi, positive when p is on its inner side.
/// Source: Van Oosterom and Strackee 1983.
double winding_fraction(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Generalized winding number of a surface: 1 inside a closed one that does not cross itself, 0
/// outside; for an open one a value between them that changes gently through its holes.
/// Source: Jacobson et al. 2013; far parts as one dipole, Barill et al. 2018.
class WindingNumber {
public:
    explicit WindingNumber(const TriangleMesh& mesh);

    /// Winding number of the surface around p, to within about 0.01.
    double around(const Vec3& p) const;

private:
    /// Triangles of a part of the surface, in a tree: those of a leaf, or two children.
    struct Node {
        Vec3 centre = Vec3::Zero();      ///< mean of the triangles' centres by area, m
        Vec3 area_normal = Vec3::Zero(); ///< sum of the triangles' areas times normals, m^2
        double radius = 0.0;             ///< radius of a ball about the centre that holds them, m
        Index first = 0, count = 0;      ///< range of triangles_
        Index right = k_no_index;        ///< child; the left one is next; none: a leaf
    };

    Index build(std::span<Index> order, std::span<const Vec3> centres, Index first);
    void measure(Node& node) const;
    std::array<Vec3, 3> corners(Index slot) const;

    std::vector<Vec3> positions_;
    std::vector<Triangle> triangles_; ///< sorted by leaf
    std::vector<Node> nodes_;
};

} // namespace weft
