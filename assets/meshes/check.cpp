#include "check.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "patch.h"
#include "proximity.h"

namespace weft {
namespace {

/// What the table says of one mesh.
struct Facts {
    bool is_manifold = true; ///< and consistently wound
    std::vector<std::vector<VertexIndex>> borders;
    int euler_characteristic = 0;
    int parts = 0;
    double edge_min = 1e9, edge_mean = 0.0, edge_max = 0.0; ///< m
    double least_angle = 180.0;                             ///< degrees
    double volume = 0.0;                                    ///< m³
    int self_crossings = 0;
};

using Edge = std::pair<VertexIndex, VertexIndex>;

const Vec3& vertex(const ObjMesh& mesh, VertexIndex v) {
    return mesh.vertices[static_cast<size_t>(v)];
}

double least_angle_deg(const ObjMesh& mesh, const Triangle& triangle) {
    double least = 180.0;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3 e = vertex(mesh, triangle[(k + 1) % 3]) - vertex(mesh, triangle[k]);
        const Vec3 f = vertex(mesh, triangle[(k + 2) % 3]) - vertex(mesh, triangle[k]);
        least = std::min(least, std::atan2(e.cross(f).norm(), e.dot(f)) * 180.0 / std::acos(-1.0));
    }
    return least;
}

int count_parts(const ObjMesh& mesh) {
    std::map<VertexIndex, std::vector<VertexIndex>> adjacent;
    for (const Triangle& triangle : mesh.triangles)
        for (size_t k = 0; k < 3; ++k)
            adjacent[triangle[k]].push_back(triangle[(k + 1) % 3]);
    std::set<VertexIndex> seen;
    int parts = 0;
    for (const auto& [start, list] : adjacent) {
        if (seen.contains(start))
            continue;
        ++parts;
        std::vector<VertexIndex> open{start};
        seen.insert(start);
        while (!open.empty()) {
            const VertexIndex v = open.back();
            open.pop_back();
            for (const VertexIndex w : adjacent[v])
                if (seen.insert(w).second)
                    open.push_back(w);
        }
    }
    return parts;
}

/// Follows border edges; clears is_manifold where a border touches itself.
void find_borders(const std::set<Edge>& directed, Facts& facts) {
    std::map<VertexIndex, VertexIndex> after;
    for (const auto& [a, b] : directed)
        if (!directed.contains({b, a}) && !after.emplace(a, b).second)
            facts.is_manifold = false;
    while (facts.is_manifold && !after.empty()) {
        std::vector<VertexIndex> loop{after.begin()->first};
        for (auto place = after.find(loop[0]); place != after.end();
             place = after.find(loop.back())) {
            loop.push_back(place->second);
            after.erase(place);
        }
        loop.pop_back();
        facts.borders.push_back(loop);
    }
}

/// Whether the triangles around each vertex form one fan or ring.
bool has_single_fans(const ObjMesh& mesh) {
    std::map<VertexIndex, std::vector<Edge>> opposite;
    for (const auto& [a, b, c] : mesh.triangles) {
        opposite[a].emplace_back(b, c);
        opposite[b].emplace_back(c, a);
        opposite[c].emplace_back(a, b);
    }
    for (auto& [v, edges] : opposite) {
        std::set<VertexIndex> reached{edges[0].first, edges[0].second};
        for (size_t round = 0; round < edges.size(); ++round)
            for (const auto& [a, b] : edges)
                if (reached.contains(a) || reached.contains(b))
                    reached.insert({a, b});
        for (const auto& [a, b] : edges)
            if (!reached.contains(a))
                return false;
    }
    return true;
}

Facts examine(const ObjMesh& mesh) {
    Facts facts;
    std::set<Edge> directed;
    std::set<Edge> edges;
    for (const Triangle& triangle : mesh.triangles) {
        for (size_t k = 0; k < 3; ++k) {
            const Edge edge(triangle[k], triangle[(k + 1) % 3]);
            facts.is_manifold = directed.insert(edge).second && facts.is_manifold;
            edges.insert(std::minmax(edge.first, edge.second));
        }
        facts.least_angle = std::min(facts.least_angle, least_angle_deg(mesh, triangle));
        facts.volume += vertex(mesh, triangle[0])
                            .dot(vertex(mesh, triangle[1]).cross(vertex(mesh, triangle[2]))) /
                        6.0;
    }
    for (const auto& [a, b] : edges) {
        const double length = (vertex(mesh, a) - vertex(mesh, b)).norm();
        facts.edge_min = std::min(facts.edge_min, length);
        facts.edge_max = std::max(facts.edge_max, length);
        facts.edge_mean += length / static_cast<double>(edges.size());
    }
    facts.is_manifold = facts.is_manifold && has_single_fans(mesh);
    facts.euler_characteristic = static_cast<int>(mesh.vertices.size() + mesh.triangles.size()) -
                                 static_cast<int>(edges.size());
    find_borders(directed, facts);
    facts.parts = count_parts(mesh);
    facts.self_crossings = count_crossings(mesh, mesh, true);
    return facts;
}

/// Counts what is not as promised, and says so.
class Verdict {
public:
    void expect(bool is_true, const std::string& promise) {
        if (is_true)
            return;
        std::printf("NOT SO: %s\n", promise.c_str());
        ++failures_;
    }
    bool is_good() const { return failures_ == 0; }

private:
    int failures_ = 0;
};

void print_facts(const std::string& name, const ObjMesh& mesh, const Facts& facts) {
    std::printf("%-10s %6zu %6zu %5d %6d %8zu %9s %5.1f %5.1f %5.1f %7.1f %6d\n", name.c_str(),
                mesh.vertices.size(), mesh.triangles.size(), facts.parts,
                facts.euler_characteristic, facts.borders.size(), facts.is_manifold ? "yes" : "NO",
                1e3 * facts.edge_min, 1e3 * facts.edge_mean, 1e3 * facts.edge_max,
                facts.least_angle, facts.self_crossings);
}

/// Distances of a garment to what is inside it.
void check_clearance(const std::string& title,
                     const ObjMesh& outer,
                     const ObjMesh& inner,
                     double wanted,
                     Verdict& verdict) {
    const double least = least_distance(outer, inner, 0.10);
    const int crossings =
        count_crossings(outer, inner, false) + count_crossings(inner, outer, false);
    std::printf("%-26s least distance %5.1f mm, crossings %d\n", title.c_str(), 1e3 * least,
                crossings);
    verdict.expect(least >= wanted && crossings == 0, title + " is clear");
}

void check_outside_body(const std::string& name,
                        const ObjMesh& garment,
                        const ObjMesh& body,
                        Verdict& verdict) {
    bool is_outside = true;
    for (const Vec3& position : garment.vertices)
        is_outside = is_outside && winding_number(position, body) < 0.5;
    verdict.expect(is_outside, name + " is outside the mannequin");
}

void check_waistband(const ObjMesh& skirt,
                     const Facts& facts,
                     const ObjMesh& body,
                     Verdict& verdict) {
    const TriangleGrid grid(body, 0.03);
    const auto height = [&](const std::vector<VertexIndex>& loop) {
        return vertex(skirt, loop[0]).y();
    };
    const auto top =
        std::max_element(facts.borders.begin(), facts.borders.end(),
                         [&](const auto& a, const auto& b) { return height(a) < height(b); });
    double least = 1.0;
    double most = 0.0;
    for (const VertexIndex v : *top) {
        const double distance = point_distance(vertex(skirt, v), body, grid, 0.05);
        least = std::min(least, distance);
        most = std::max(most, distance);
    }
    std::printf("waistband: %zu vertices, %.1f to %.1f mm off the mannequin\n", top->size(),
                1e3 * least, 1e3 * most);
    verdict.expect(least >= 6e-3 && most <= 8.1e-3, "the waistband is 6 to 8 mm off");
}

} // namespace

bool check_meshes(const std::filesystem::path& folder) {
    struct Expected {
        const char* name;
        size_t borders;
        int euler_characteristic;
    };
    constexpr std::array<Expected, 8> k_expected{{{"mannequin", 0, 2},
                                                  {"skirt", 2, 0},
                                                  {"tshirt", 4, -2},
                                                  {"dress", 4, -2},
                                                  {"tablecloth", 1, 1},
                                                  {"flag", 1, 1},
                                                  {"plate_with_hole", 0, 0},
                                                  {"rabbit", 0, 2}}};
    Verdict verdict;
    std::map<std::string, ObjMesh> meshes;
    std::map<std::string, Facts> facts;
    std::puts("mesh         verts   tris parts  Euler  borders  manifold  edge min/mean/max mm  "
              "angle  self-x");
    for (const auto& [name, borders, euler] : k_expected) {
        const ObjMesh& mesh = meshes[name] = read_obj(folder / (std::string(name) + ".obj"));
        const Facts& f = facts[name] = examine(mesh);
        print_facts(name, mesh, f);
        verdict.expect(f.is_manifold && f.parts == 1 && f.borders.size() == borders &&
                           f.euler_characteristic == euler,
                       std::string(name) + " has the right topology");
        verdict.expect(f.least_angle >= 20.0, std::string(name) + " has no angle below 20 degrees");
        verdict.expect(f.self_crossings == 0, std::string(name) + " does not cross itself");
        verdict.expect(mesh.material_triangles.size() == (borders > 0 ? mesh.triangles.size() : 0),
                       std::string(name) + " has its flat pattern");
    }
    for (const char* name : {"mannequin", "plate_with_hole", "rabbit"}) {
        std::printf("%s: volume %.4f m3\n", name, facts[name].volume);
        verdict.expect(facts[name].volume > 0.0, std::string(name) + " faces outwards");
    }
    const ObjMesh& body = meshes["mannequin"];
    for (const char* name : {"skirt", "tshirt", "dress"}) {
        check_clearance(std::string(name) + " over mannequin", meshes[name], body, 5e-3, verdict);
        check_outside_body(name, meshes[name], body, verdict);
    }
    check_clearance("tshirt over skirt", meshes["tshirt"], meshes["skirt"], 6e-3, verdict);
    check_waistband(meshes["skirt"], facts["skirt"], body, verdict);
    return verdict.is_good();
}

} // namespace weft
