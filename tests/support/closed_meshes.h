#pragma once

#include "geometry/triangle_mesh.h"

#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace weft::test {

/// A torus about the z axis, `around` by `across` quads.
inline TriangleMesh torus(double radius, double thickness, int around, int across) {
    TriangleMesh mesh;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double u = 2.0 * std::numbers::pi * i / around;
            const double v = 2.0 * std::numbers::pi * j / across;
            const double r = radius + thickness * std::cos(v);
            mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), thickness * std::sin(v));
            const Index a = i * across + j;
            const Index b = (i + 1) % around * across + j;
            const Index c = (i + 1) % around * across + (j + 1) % across;
            const Index d = i * across + (j + 1) % across;
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
        }
    }
    return mesh;
}

/// A sphere about the origin, its poles on the z axis.
inline TriangleMesh globe(double radius, int around, int down) {
    TriangleMesh mesh;
    mesh.positions.emplace_back(0.0, 0.0, radius);
    for (int i = 1; i < down; ++i) {
        for (int j = 0; j < around; ++j) {
            const double u = std::numbers::pi * i / down;
            const double v = 2.0 * std::numbers::pi * j / around;
            mesh.positions.emplace_back(
                radius * Vec3(std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u)));
        }
    }
    mesh.positions.emplace_back(0.0, 0.0, -radius);
    const auto last = static_cast<Index>(mesh.positions.size()) - 1;
    for (int j = 0; j < around; ++j) {
        const int k = (j + 1) % around;
        mesh.triangles.push_back({0, 1 + j, 1 + k});
        for (int i = 0; i + 2 < down; ++i) {
            const Index row = 1 + i * around;
            mesh.triangles.push_back({row + j, row + around + j, row + around + k});
            mesh.triangles.push_back({row + j, row + around + k, row + k});
        }
        mesh.triangles.push_back({last, last - around + k, last - around + j});
    }
    return mesh;
}

/// The outside of some unit cubes, each by its low corner, with shared vertices.
inline TriangleMesh cubes(const std::vector<std::array<int, 3>>& corners) {
    TriangleMesh mesh;
    std::map<std::array<int, 3>, Index> vertices;
    const auto vertex = [&](const std::array<int, 3>& p) {
        const auto [found, is_new] = vertices.emplace(p, static_cast<Index>(mesh.positions.size()));
        if (is_new) {
            mesh.positions.emplace_back(p[0], p[1], p[2]);
        }
        return found->second;
    };
    for (const auto& cube : corners) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int side : {0, 1}) {
                auto beside = cube;
                beside[axis] += side == 1 ? 1 : -1;
                if (std::find(corners.begin(), corners.end(), beside) != corners.end()) {
                    continue;
                }
                std::array<Index, 4> quad{};
                const int turn[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
                for (std::size_t k = 0; k < 4; ++k) {
                    auto p = cube;
                    p[axis] += side;
                    p[(axis + 1) % 3] += turn[side == 1 ? k : 3 - k][0];
                    p[(axis + 2) % 3] += turn[side == 1 ? k : 3 - k][1];
                    quad[k] = vertex(p);
                }
                mesh.triangles.push_back({quad[0], quad[1], quad[2]});
                mesh.triangles.push_back({quad[0], quad[2], quad[3]});
            }
        }
    }
    return mesh;
}

/// Volume that a closed mesh holds, by the divergence theorem, m^3.
inline double volume_of(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
        const auto x = [&](std::size_t k) {
            return mesh.positions[static_cast<std::size_t>(t[k])];
        };
        sum += x(0).dot(x(1).cross(x(2))) / 6.0;
    }
    return sum;
}

/// The mesh turned about a random axis by a random angle, then moved by up to 1 m.
inline TriangleMesh turned(TriangleMesh mesh, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto vector = [&] {
        const double x = unit(engine);
        const double y = unit(engine);
        return Vec3(x, y, unit(engine));
    };
    const Vec3 axis = vector().normalized();
    const Mat3 turn = Eigen::AngleAxisd(3.0 * unit(engine), axis).toRotationMatrix();
    const Vec3 shift = vector();
    for (Vec3& x : mesh.positions) {
        x = turn * x + shift;
    }
    return mesh;
}

/// The mesh `factor` times as large about the origin.
inline TriangleMesh scaled(TriangleMesh mesh, double factor) {
    for (Vec3& x : mesh.positions) {
        x *= factor;
    }
    return mesh;
}

} // namespace weft::test
