#include "isosurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace weft {
namespace {

/// The six tetrahedra around the diagonal 0-7 of a cube; corner bits are x, y, z (1, 2, 4). All
/// cubes are divided alike, so that neighbours agree on the diagonals of their common face.
constexpr std::array<std::array<int, 4>, 6> k_tetrahedra{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

class Marcher {
public:
    Marcher(const Field& field, const Vec3& box_min, const Vec3& box_max, double spacing)
        : origin_(box_min), spacing_(spacing) {
        for (int axis = 0; axis < 3; ++axis)
            size_[axis] =
                static_cast<int>(std::ceil((box_max[axis] - box_min[axis]) / spacing)) + 1;
        values_.reserve(static_cast<size_t>(size_.prod()));
        for (int k = 0; k < size_.z(); ++k)
            for (int j = 0; j < size_.y(); ++j)
                for (int i = 0; i < size_.x(); ++i)
                    values_.push_back(field(position(index(i, j, k))));
    }

    Patch run() {
        for (int k = 0; k + 1 < size_.z(); ++k)
            for (int j = 0; j + 1 < size_.y(); ++j)
                for (int i = 0; i + 1 < size_.x(); ++i)
                    march_cube(i, j, k);
        patch_.curves.assign(patch_.vertices.size(), 0);
        patch_.panels.assign(patch_.triangles.size(), 0);
        return std::move(patch_);
    }

private:
    int index(int i, int j, int k) const { return i + size_.x() * (j + size_.y() * k); }

    Vec3 position(int n) const {
        const int i = n % size_.x();
        const int j = n / size_.x() % size_.y();
        const int k = n / (size_.x() * size_.y());
        return origin_ + spacing_ * Vec3(i, j, k);
    }

    double value(int n) const { return values_[static_cast<size_t>(n)]; }

    void march_cube(int i, int j, int k) {
        for (const auto& corners : k_tetrahedra) {
            std::vector<int> inside;
            std::vector<int> outside;
            for (const int c : corners) {
                const int n = index(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1));
                (value(n) < 0.0 ? inside : outside).push_back(n);
            }
            if (inside.size() == 1)
                append({edge_vertex(inside[0], outside[0]), edge_vertex(inside[0], outside[1]),
                        edge_vertex(inside[0], outside[2])},
                       position(outside[0]) - position(inside[0]));
            else if (inside.size() == 3)
                append({edge_vertex(inside[0], outside[0]), edge_vertex(inside[1], outside[0]),
                        edge_vertex(inside[2], outside[0])},
                       position(outside[0]) - position(inside[0]));
            else if (inside.size() == 2) {
                const VertexIndex a = edge_vertex(inside[0], outside[0]);
                const VertexIndex b = edge_vertex(inside[0], outside[1]);
                const VertexIndex c = edge_vertex(inside[1], outside[1]);
                const VertexIndex d = edge_vertex(inside[1], outside[0]);
                const Vec3 outward = position(outside[0]) + position(outside[1]) -
                                     position(inside[0]) - position(inside[1]);
                append({a, b, c}, outward);
                append({a, c, d}, outward);
            }
        }
    }

    void append(Triangle triangle, const Vec3& outward) {
        const auto x = [&](size_t k) { return patch_.vertices[static_cast<size_t>(triangle[k])]; };
        if ((x(1) - x(0)).cross(x(2) - x(0)).dot(outward) < 0.0)
            std::swap(triangle[1], triangle[2]);
        patch_.triangles.push_back(triangle);
    }

    VertexIndex edge_vertex(int a, int b) {
        if (a > b)
            std::swap(a, b);
        const auto key = static_cast<std::int64_t>(a) << 32 | b;
        const auto [place, is_new] = edges_.try_emplace(key, patch_.vertices.size());
        if (is_new) {
            // Kept off the grid points, where several vertices would fall together.
            const double t = std::clamp(value(a) / (value(a) - value(b)), 0.02, 0.98);
            patch_.vertices.push_back((1.0 - t) * position(a) + t * position(b));
        }
        return static_cast<VertexIndex>(place->second);
    }

    Vec3 origin_;
    double spacing_;
    Eigen::Vector3i size_;
    std::vector<double> values_;
    std::unordered_map<std::int64_t, size_t> edges_;
    Patch patch_;
};

} // namespace

Patch extract_isosurface(const Field& field,
                         const Vec3& box_min,
                         const Vec3& box_max,
                         double spacing) {
    return Marcher(field, box_min, box_max, spacing).run();
}

} // namespace weft
