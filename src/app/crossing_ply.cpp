#include "app/crossing_ply.h"

#include "geometry/crossing.h"

#include <fmt/core.h>

#include <map>
#include <set>

namespace weft {

namespace {

constexpr const char* k_red = "220 60 50";
constexpr const char* k_blue = "70 110 200";
constexpr const char* k_yellow = "250 220 60";

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

/// Positions and triangles of one object of a world, cloths first.
class ObjectShape {
public:
    ObjectShape(const World& world, Index object) {
        if (at(object) < world.cloths.size()) {
            const Cloth& cloth = world.cloths[at(object)];
            const auto x = world.positions_of(cloth);
            positions_.assign(x.begin(), x.end());
            triangles_ = cloth.triangles;
        } else {
            const Obstacle& obstacle = world.obstacles[at(object) - world.cloths.size()];
            positions_.resize(obstacle.mesh.positions.size());
            obstacle_positions(obstacle, world.time, positions_);
            triangles_ = obstacle.mesh.triangles;
        }
    }

    std::array<Vec3, 3> corners(Index triangle) const {
        const Triangle& t = triangles_[at(triangle)];
        return {positions_[at(t[0])], positions_[at(t[1])], positions_[at(t[2])]};
    }
    const Triangle& triangle(Index number) const { return triangles_[at(number)]; }

private:
    std::vector<Vec3> positions_;
    std::vector<Triangle> triangles_;
};

std::string vertex_line(const Vec3& x, const char* colour) {
    return fmt::format("{:.9g} {:.9g} {:.9g} {}\n", x.x(), x.y(), x.z(), colour);
}

/// The segment that a pair shares; corners that the two have in common keep one number.
std::array<Vec3, 2>
segment_of(const ContactProblem& pair, const ObjectShape& a, const ObjectShape& b) {
    std::vector<Vec3> x;
    std::array<Triangle, 2> local{{{0, 1, 2}, {3, 4, 5}}};
    for (const Vec3& corner : a.corners(pair.triangles[0])) {
        x.push_back(corner);
    }
    for (const Vec3& corner : b.corners(pair.triangles[1])) {
        x.push_back(corner);
    }
    for (std::size_t i = 0; pair.objects[0] == pair.objects[1] && i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            if (a.triangle(pair.triangles[0])[i] == b.triangle(pair.triangles[1])[j]) {
                local[1][j] = static_cast<Index>(i);
            }
        }
    }
    return crossing_segment(local[0], local[1], x);
}

} // namespace

std::string encode_crossings(const World& world, std::span<const ContactProblem> pairs) {
    std::map<Index, ObjectShape> shapes;
    std::set<std::array<Index, 2>> triangles;
    for (const ContactProblem& pair : pairs) {
        for (std::size_t side = 0; side < 2; ++side) {
            shapes.try_emplace(pair.objects[side], world, pair.objects[side]);
            triangles.insert({pair.objects[side], pair.triangles[side]});
        }
    }
    std::string vertices;
    std::string faces;
    std::string edges;
    std::size_t next = 0;
    for (const auto& [object, triangle] : triangles) {
        const char* colour = at(object) < world.cloths.size() ? k_red : k_blue;
        for (const Vec3& x : shapes.at(object).corners(triangle)) {
            vertices += vertex_line(x, colour);
        }
        faces += fmt::format("3 {} {} {} {} {} {}\n", next, next + 1, next + 2, colour, object,
                             triangle);
        next += 3;
    }
    for (const ContactProblem& pair : pairs) {
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
