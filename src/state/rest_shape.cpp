#include "state/rest_shape.h"

#include "base/error.h"
#include "geometry/curvature.h"
#include "state/cloth.h"

#include <Eigen/LU>

#include <algorithm>
#include <cassert>
#include <numbers>

namespace weft {

namespace {

constexpr double k_level =
    0.98; // |n.y| above which a triangle counts as level: y has no direction in it

/// Columns: unit weft and warp directions in the plane of a triangle with edges e1, e2.
struct Frame2 {
    Vec3 weft, warp;
};

Frame2 frame_from_weft(const Vec3& along, const Vec3& normal) {
    const Vec3 weft = (along - along.dot(normal) * normal).normalized();
    return {weft, normal.cross(weft)};
}

Frame2 frame_from_axes(const Vec3& normal) {
    const Vec3 axis = std::abs(normal.y()) < k_level ? Vec3::UnitY() : Vec3(-Vec3::UnitZ());
    const Vec3 warp = (axis - axis.dot(normal) * normal).normalized();
    return {warp.cross(normal), warp};
}

Frame2 material_frame(const Mat32& edges, const Vec3& normal, const std::array<Vec2, 3>* uv) {
    if (uv != nullptr) {
        Mat2 duv;
        duv << (*uv)[1] - (*uv)[0], (*uv)[2] - (*uv)[0];
        const double det = duv.determinant();
        if (std::abs(det) > 1e-12 * duv.squaredNorm()) {
            const Vec3 along = (edges.col(0) * duv(1, 1) - edges.col(1) * duv(1, 0)) / det;
            return frame_from_weft(along, normal);
        }
    }
    return frame_from_axes(normal);
}

Mat2 turn(double degrees) {
    return Eigen::Rotation2Dd(-degrees * std::numbers::pi / 180.0).toRotationMatrix();
}

RestTriangle rest_triangle(const Mat2& edges) {
    return {edges.inverse(), 0.5 * edges.determinant()};
}

/// Rest edges of triangle t in weft/warp coordinates, before the grain's turn.
Mat2 rest_edges(const Cloth& cloth,
                std::size_t t,
                std::span<const Vec3> positions,
                const std::array<Vec2, 3>* uv) {
    if (cloth.params.rest == RestShape::Uv) {
        Mat2 edges;
        edges << (*uv)[1] - (*uv)[0], (*uv)[2] - (*uv)[0];
        edges *= cloth.params.uv_scale;
        if (edges.determinant() < 0.0) {
            edges.row(0) *= -1.0; // a mirrored panel: the same fabric seen from its other side
        }
        return edges;
    }
    const Triangle& v = cloth.triangles[t];
    const auto at = [&](std::size_t k) { return positions[static_cast<std::size_t>(v[k])]; };
    Mat32 edges;
    edges << at(1) - at(0), at(2) - at(0);
    const Frame2 frame = material_frame(edges, triangle_normal(at(0), at(1), at(2)), uv);
    Mat2 flat;
    flat.row(0) = frame.weft.transpose() * edges;
    flat.row(1) = frame.warp.transpose() * edges;
    return flat;
}

std::vector<Vec2> vertex_material_positions(const Cloth& cloth,
                                            std::span<const Vec3> positions,
                                            std::span<const std::array<Vec2, 3>> corner_uv) {
    std::vector<Vec2> material(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        material[i] = positions[i].head<2>();
    }
    for (std::size_t t = corner_uv.size(); t-- > 0;) { // backwards: the first triangle's uv stays
        for (std::size_t k = 0; k < 3; ++k) {
            material[static_cast<std::size_t>(cloth.triangles[t][k])] =
                cloth.params.uv_scale * corner_uv[t][k];
        }
    }
    return material;
}

} // namespace

void build_rest_shape(Cloth& cloth,
                      std::span<const Vec3> positions,
                      std::span<const std::array<Vec2, 3>> corner_uv) {
    if (cloth.params.rest == RestShape::Uv && corner_uv.empty()) {
        fail_input("cloth '{}': rest = \"uv\": the mesh has no uv; use rest = \"mesh\"",
                   cloth.name);
    }
    cloth.rest.resize(cloth.triangles.size());
    const Mat2 grain = turn(cloth.params.grain_deg);
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        const Mat2 edges =
            grain * rest_edges(cloth, t, positions, corner_uv.empty() ? nullptr : &corner_uv[t]);
        if (!(edges.determinant() > 1e-9 * edges.squaredNorm())) {
            fail_input(
                "cloth '{}': rest shape of triangle {} has no area ({:.3g} m^2); must be > 0",
                cloth.name, t, 0.5 * edges.determinant());
        }
        cloth.rest[t] = rest_triangle(edges);
    }
    cloth.material_positions = vertex_material_positions(cloth, positions, corner_uv);
}

std::vector<double> mixed_rest_areas(const Cloth& cloth) {
    std::vector<double> areas(at(cloth.vertex_count), 0.0);
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        const auto parts = mixed_corner_areas(rest_corners(cloth.rest[t]));
        for (std::size_t k = 0; k < 3; ++k) {
            areas[at(cloth.triangles[t][k])] += parts[k];
        }
    }
    return areas;
}

double rest_area(const Cloth& cloth) {
    double area = 0.0;
    for (const RestTriangle& rest : cloth.rest) {
        area += rest.area;
    }
    return area;
}

std::array<Vec2, 3> rest_corners(const RestTriangle& rest) {
    const Mat2& m = rest.inverse_edges;
    const double det = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
    assert(det != 0.0);
    return {Vec2::Zero(), Vec2(m(1, 1), -m(1, 0)) / det, Vec2(-m(0, 1), m(0, 0)) / det};
}

double rest_edge_length(const RestTriangle& rest, int k) {
    const auto corners = rest_corners(rest);
    return (corners[static_cast<std::size_t>((k + 2) % 3)] -
            corners[static_cast<std::size_t>((k + 1) % 3)])
        .norm();
}

double least_angle(const RestTriangle& rest) {
    const auto corners = rest_corners(rest);
    double least = std::numbers::pi / 3.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 a = corners[(k + 1) % 3] - corners[k];
        const Vec2 b = corners[(k + 2) % 3] - corners[k];
        least = std::min(least, std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
    }
    return least;
}

} // namespace weft
