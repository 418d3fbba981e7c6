#include "scene/joined_mesh.h"

#include "geometry/weld.h"

#include <algorithm>
#include <map>

namespace weft {
namespace {

void renumber(TriangleMesh& mesh, std::span<const Index> new_index) {
    for (Triangle& triangle : mesh.triangles) {
        for (Index& v : triangle) {
            v = new_index[static_cast<std::size_t>(v)];
        }
    }
}

void append(const FileObject& object, std::size_t number, const Mat3& to_world, JoinedMesh& all) {
    const auto first = static_cast<Index>(all.mesh.positions.size());
    for (const Vec3& p : object.positions) {
        all.sources.push_back(
            {static_cast<Index>(number), static_cast<Index>(all.mesh.positions.size()) - first});
        all.mesh.positions.emplace_back(to_world * p);
    }
    for (std::size_t t = 0; t < object.triangles.size(); ++t) {
        const Triangle& v = object.triangles[t];
        all.mesh.triangles.push_back({v[0] + first, v[1] + first, v[2] + first});
        all.origins.push_back({number, object.face_of_triangle[t]});
    }
}

} // namespace

JoinedMesh
join_objects(const MeshFile& file, std::span<const std::size_t> chosen, const Mat3& to_world) {
    const bool all_have_uv = std::all_of(chosen.begin(), chosen.end(), [&](std::size_t i) {
        return file.objects[i].corner_uv.size() == file.objects[i].triangles.size();
    });
    JoinedMesh all;
    for (const std::size_t i : chosen) {
        append(file.objects[i], i, to_world, all);
        if (all_have_uv) {
            const auto& uv = file.objects[i].corner_uv;
            all.corner_uv.insert(all.corner_uv.end(), uv.begin(), uv.end());
        }
    }
    return all;
}

std::size_t drop_unused_vertices(JoinedMesh& joined) {
    TriangleMesh& mesh = joined.mesh;
    std::vector<Index> new_index(mesh.positions.size(), k_no_index);
    for (const Triangle& triangle : mesh.triangles) {
        for (const Index v : triangle) {
            new_index[static_cast<std::size_t>(v)] = 0;
        }
    }
    std::size_t kept = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (new_index[v] != k_no_index) {
            mesh.positions[kept] = mesh.positions[v];
            joined.sources[kept] = joined.sources[v];
            new_index[v] = static_cast<Index>(kept++);
        }
    }
    const std::size_t dropped = mesh.positions.size() - kept;
    mesh.positions.resize(kept);
    joined.sources.resize(kept);
    renumber(mesh, new_index);
    return dropped;
}

void weld_mesh(JoinedMesh& joined, double tolerance, std::span<const Index> groups) {
    std::vector<Vec3>& positions = joined.mesh.positions;
    std::map<Index, std::vector<Index>> members; // by group, ascending
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const auto object = static_cast<std::size_t>(joined.sources[v].object);
        members[groups.empty() ? 0 : groups[object]].push_back(static_cast<Index>(v));
    }
    std::vector<Index> stands_for(positions.size(), k_no_index); // the first of those joined
    for (const auto& [group, vertices] : members) {
        std::vector<Vec3> places;
        for (const Index v : vertices) {
            places.push_back(positions[static_cast<std::size_t>(v)]);
        }
        const Weld weld = weld_vertices(places, tolerance);
        std::vector<Index> first(weld.positions.size(), k_no_index);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            Index& of_place = first[static_cast<std::size_t>(weld.new_index[i])];
            of_place = of_place == k_no_index ? vertices[i] : of_place;
            stands_for[static_cast<std::size_t>(vertices[i])] = of_place;
        }
    }
    std::vector<Index> new_index(positions.size());
    std::size_t kept = 0;
    for (std::size_t v = 0; v < new_index.size(); ++v) {
        const auto first = static_cast<std::size_t>(stands_for[v]);
        if (first == v) {
            positions[kept] = positions[v];
            joined.sources[kept] = joined.sources[v];
            new_index[v] = static_cast<Index>(kept++);
        } else {
            new_index[v] = new_index[first];
        }
    }
    positions.resize(kept);
    joined.sources.resize(kept);
    renumber(joined.mesh, new_index);
}

void drop_triangles(JoinedMesh& joined, std::span<const Index> numbers) {
    std::size_t kept = 0;
    auto next = numbers.begin();
    for (std::size_t t = 0; t < joined.mesh.triangles.size(); ++t) {
        if (next != numbers.end() && static_cast<std::size_t>(*next) == t) {
            ++next;
            continue;
        }
        joined.mesh.triangles[kept] = joined.mesh.triangles[t];
        joined.origins[kept] = joined.origins[t];
        if (!joined.corner_uv.empty()) {
            joined.corner_uv[kept] = joined.corner_uv[t];
        }
        ++kept;
    }
    joined.mesh.triangles.resize(kept);
    joined.origins.resize(kept);
    if (!joined.corner_uv.empty()) {
        joined.corner_uv.resize(kept);
    }
}

std::vector<Index> polygon_numbers(const JoinedMesh& joined) {
    std::vector<Index> numbers;
    for (std::size_t t = 0; t < joined.origins.size(); ++t) {
        const bool is_same = t > 0 && joined.origins[t] == joined.origins[t - 1];
        numbers.push_back(numbers.empty() ? 0 : numbers.back() + (is_same ? 0 : 1));
    }
    return numbers;
}

void flip_corner_uv(JoinedMesh& joined, std::size_t triangle) {
    if (!joined.corner_uv.empty()) {
        std::swap(joined.corner_uv[triangle][1], joined.corner_uv[triangle][2]);
    }
}

} // namespace weft
