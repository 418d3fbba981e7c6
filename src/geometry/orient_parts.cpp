#include "geometry/orient_parts.h"

#include "geometry/winding_number.h"

#include <cmath>

namespace weft {

namespace {

struct Part {
    TriangleMesh mesh;   ///< with all of the mesh's positions
    double volume = 0.0; ///< m^3, negative when wound inward
};

std::vector<Part> take_apart(const TriangleMesh& mesh, const std::vector<int>& part_of, int count) {
    std::vector<Part> parts(static_cast<std::size_t>(count));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Part& part = parts[static_cast<std::size_t>(part_of[t])];
        part.mesh.triangles.push_back(mesh.triangles[t]);
        const auto x = [&](std::size_t k) {
            return mesh.positions[static_cast<std::size_t>(mesh.triangles[t][k])];
        };
        part.volume += x(0).dot(x(1).cross(x(2))) / 6.0;
    }
    for (Part& part : parts) {
        part.mesh.positions = mesh.positions;
    }
    return parts;
}

} // namespace

void orient_parts(TriangleMesh& mesh) {
    std::vector<int> part_of;
    const int count = connected_parts(mesh.triangles, part_of);
    const std::vector<Part> parts = take_apart(mesh, part_of, count);
    std::vector<WindingNumber> windings;
    for (const Part& part : parts) {
        windings.emplace_back(part.mesh);
    }
    std::vector<char> turn(parts.size(), 0);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const Triangle& first = parts[p].mesh.triangles[0];
        int around = 0;
        for (std::size_t other = 0; other < parts.size(); ++other) {
            const Vec3& x = mesh.positions[static_cast<std::size_t>(first[0])];
            around += other != p && std::abs(windings[other].at(x)) > 0.5 ? 1 : 0;
        }
        const bool wants_outward = around % 2 == 0;
        turn[p] = (parts[p].volume > 0.0) == wants_outward ? 0 : 1;
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (turn[static_cast<std::size_t>(part_of[t])] != 0) {
            std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
        }
    }
}

} // namespace weft
