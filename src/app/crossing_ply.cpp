#include "app/crossing_ply.h"

#include "geometry/crossing.h"
#include "state/world.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <set>

namespace weft {

namespace {

constexpr const char* k_red = "220 60 50";
constexpr const char* k_blue = "70 110 200";
constexpr const char* k_yellow = "250 220 60";

std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, Index triangle) {
    const Triangle& t = mesh.triangles[at(triangle)];
    return {mesh.positions[at(t[0])], mesh.positions[at(t[1])], mesh.positions[at(t[2])]};
}

std::string vertex_line(const Vec3& x, const char* colour) {
    return fmt::format("{:.9g} {:.9g} {:.9g} {}\n", x.x(), x.y(), x.z(), colour);
}

/// The segment that a pair shares; corners that the two have in common keep one number.
std::array<Vec3, 2>
segment_of(const UnresolvedPair& pair, const TriangleMesh& a, const TriangleMesh& b) {
    std::vector<Vec3> x;
    std::array<Triangle, 2> local{{{0, 1, 2}, {3, 4, 5}}};
    for (const Vec3& corner : corners_of(a, pair.triangles[0])) {
        x.push_back(corner);
    }
    for (const Vec3& corner : corners_of(b, pair.triangles[1])) {
        x.push_back(corner);
    }
    for (std::size_t i = 0; pair.objects[0] == pair.objects[1] && i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            if (a.triangles[at(pair.triangles[0])][i] == b.triangles[at(pair.triangles[1])][j]) {
                local[1][j] = static_cast<Index>(i);
            }
        }
    }
    return crossing_segment(local[0], local[1], x);
}

} // namespace

std::string encode_crossings(const World& world, std::span<const UnresolvedPair> pairs) {
    const std::vector<ObjectId> objects = objects_of(world);
    std::map<ObjectId, TriangleMesh> shapes;
    std::set<std::pair<ObjectId, Index>> triangles;
    for (const UnresolvedPair& pair : pairs) {
        for (std::size_t side = 0; side < 2; ++side) {
            if (!shapes.contains(pair.objects[side])) {
                shapes.emplace(pair.objects[side], object_mesh(world, pair.objects[side]));
            }
            triangles.insert({pair.objects[side], pair.triangles[side]});
        }
    }
    std::string vertices;
    std::string faces;
    std::string edges;
    std::size_t next = 0;
    for (const auto& [object, triangle] : triangles) {
        const char* colour = object.is_obstacle() ? k_blue : k_red;
        for (const Vec3& x : corners_of(shapes.at(object), triangle)) {
            vertices += vertex_line(x, colour);
        }
        const auto number = std::find(objects.begin(), objects.end(), object) - objects.begin();
        faces += fmt::format("3 {} {} {} {} {} {}\n", next, next + 1, next + 2, colour, number,
                             triangle);
        next += 3;
    }
    for (const UnresolvedPair& pair : pairs) {
        for (const Vec3& end :
             segment_of(pair, shapes.at(pair.objects[0]), shapes.at(pair.objects[1]))) {
            vertices += vertex_line(end, k_yellow);
        }
        edges += fmt::format("{} {} {}\n", next, next + 1, k_yellow);
        next += 2;
    }
    const char* colour = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    return fmt::format("ply\nformat ascii 1.0\ncomment triangles that cross, and where\n"
                       "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}"
                       "element face {}\nproperty list uchar int vertex_indices\n{}"
                       "property int object\nproperty int triangle\n"
                       "element edge {}\nproperty int vertex1\nproperty int vertex2\n{}"
                       "end_header\n",
                       next, colour, triangles.size(), colour, pairs.size(), colour) +
           vertices + faces + edges;
}

} // namespace weft
