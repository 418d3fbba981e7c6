#include "scene/cache_order.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "geometry/weld.h"
#include "scene/mesh_assembly.h"
#include "scene/text_scan.h"

#include <algorithm>

namespace weft {

namespace {

/// The `v` lines; check_obj has seen that they are numbers.
std::vector<Vec3> obj_vertices(const std::filesystem::path& file, const Mat3& to_world) {
    const std::string text = read_file(file);
    LineScanner lines(text);
    std::string_view line;
    std::vector<std::string_view> words;
    std::vector<Vec3> vertices;
    while (lines.next(line)) {
        split_words(line, words);
        if (words.size() >= 4 && words[0] == "v") {
            const Vec3 x(to_number(words[1]).value_or(0.0), to_number(words[2]).value_or(0.0),
                         to_number(words[3]).value_or(0.0));
            vertices.push_back(x.allFinite() ? Vec3(to_world * x) : Vec3::Zero()); // if unused
        }
    }
    return vertices;
}

/// The first of `points` at the place of each vertex.
std::vector<Index>
match(const std::vector<Vec3>& points, const std::vector<Vec3>& vertices, const std::string& name) {
    std::vector<Vec3> all = points;
    all.insert(all.end(), vertices.begin(), vertices.end());
    // Twice the tolerance of import: a vertex may stand at another of the points joined in it.
    const Weld weld = weld_vertices(all, 2.0 * k_weld_share * bounding_diagonal(all));
    std::vector<Index> first(weld.positions.size(), k_no_index);
    for (std::size_t i = 0; i < points.size(); ++i) {
        Index& of_place = first[static_cast<std::size_t>(weld.new_index[i])];
        of_place = of_place == k_no_index ? static_cast<Index>(i) : of_place;
    }
    std::vector<Index> order;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        order.push_back(first[static_cast<std::size_t>(weld.new_index[points.size() + v])]);
        if (order.back() == k_no_index) {
            fail_input("{}: vertex {} (after welding) stands at no v line of the file", name, v);
        }
    }
    return order;
}

[[noreturn]] void refuse_count(const std::string& cache,
                               std::size_t points,
                               const std::string& mesh,
                               std::size_t vertices) {
    fail_input("{}: has {} points, {} has {} vertices: must be as many, in the file's order", cache,
               points, mesh, vertices);
}

bool is_obj(const std::filesystem::path& file) {
    const std::string extension = file.extension().string();
    return extension == ".obj" || extension == ".OBJ";
}

} // namespace

std::vector<Index> cache_order(const std::filesystem::path& file,
                               const MeshSource& source,
                               const ImportedMesh& imported,
                               std::size_t points,
                               const std::string& cache) {
    if (is_obj(file)) {
        const std::vector<Vec3> vertices = obj_vertices(file, imported.to_world);
        if (vertices.size() != points) {
            refuse_count(cache, points, source.file, vertices.size());
        }
        return match(vertices, imported.mesh.positions, source.file);
    }
    if (imported.vertices_in_file != points) {
        refuse_count(cache, points, source.file, imported.vertices_in_file);
    }
    std::vector<Index> order;
    for (const auto [object, vertex] : imported.sources) {
        if (object != imported.sources[0].object) {
            fail_input("{}: a cache of a mesh of several objects: must be one, or an OBJ file",
                       source.file);
        }
        order.push_back(vertex);
    }
    return order;
}

} // namespace weft
