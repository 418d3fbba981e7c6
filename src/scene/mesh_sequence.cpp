#include "scene/mesh_sequence.h"

#include "base/error.h"

#include <algorithm>
#include <charconv>
#include <numeric>

namespace weft {
namespace {

/// What stands before the marks of a file's name, how many there are, and what stands behind.
struct Pattern {
    std::string before, after;
    std::size_t marks = 0;
};

Pattern split_pattern(const std::string& pattern) {
    const std::string name = std::filesystem::path(pattern).filename().string();
    const std::size_t first = name.find('#');
    const std::size_t end = name.find_first_not_of('#', first);
    const bool has_more = end != std::string::npos && name.find('#', end) != std::string::npos;
    if (first == std::string::npos || has_more) {
        fail_input("sequence = \"{}\": must have one group of # in its file name, which stands for "
                   "the number",
                   pattern);
    }
    return {name.substr(0, first), end == std::string::npos ? "" : name.substr(end),
            (end == std::string::npos ? name.size() : end) - first};
}

/// The number in a file name that fits, or -1.
int number_in(const std::string& name, const Pattern& pattern) {
    if (name.size() < pattern.before.size() + pattern.after.size() + pattern.marks ||
        !name.starts_with(pattern.before) || !name.ends_with(pattern.after)) {
        return -1;
    }
    const std::string_view digits = std::string_view(name).substr(
        pattern.before.size(), name.size() - pattern.before.size() - pattern.after.size());
    int number = -1;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool is_whole = error == std::errc() && end == digits.data() + digits.size();
    const bool fits = digits.size() == pattern.marks || digits[0] != '0';
    return is_whole && fits && digits[0] != '-' ? number : -1;
}

std::size_t total(const std::vector<std::size_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

std::vector<std::size_t> vertex_counts(const MeshFile& file) {
    std::vector<std::size_t> counts;
    for (const FileObject& object : file.objects) {
        counts.push_back(object.positions.size());
    }
    return counts;
}

std::vector<std::vector<Triangle>> triangles_of(const MeshFile& file) {
    std::vector<std::vector<Triangle>> triangles;
    for (const FileObject& object : file.objects) {
        triangles.push_back(object.triangles);
    }
    return triangles;
}

std::size_t triangle_count(const std::vector<std::vector<Triangle>>& triangles) {
    std::size_t count = 0;
    for (const auto& of_object : triangles) {
        count += of_object.size();
    }
    return count;
}

} // namespace

SequenceFiles find_sequence(const std::filesystem::path& base_dir, const std::string& pattern) {
    const Pattern parts = split_pattern(pattern);
    const std::filesystem::path folder = std::filesystem::path(pattern).parent_path();
    std::vector<std::pair<int, std::string>> found;
    std::error_code ignored; // no folder: no files
    for (const auto& entry : std::filesystem::directory_iterator(
             folder.empty() && base_dir.empty() ? "." : base_dir / folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (const int number = number_in(name, parts); number >= 0) {
            found.emplace_back(number, name);
        }
    }
    if (found.empty()) {
        fail_input("{}: no file has such a name", pattern);
    }
    std::sort(found.begin(), found.end());
    SequenceFiles result;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto [number, name] = found[i];
        if (i > 0 && number != found[i - 1].first + 1) {
            fail_input("{}: number {} is missing: {} follows {}", pattern, found[i - 1].first + 1,
                       name, found[i - 1].second);
        }
        result.files.push_back(base_dir / folder / name);
        result.names.push_back((folder / name).generic_string());
    }
    return result;
}

SequenceReader::SequenceReader(SequenceFiles files,
                               const MeshSource& source,
                               const ImportedMesh& first)
    : files_(std::move(files)), source_(source), vertices_(first.sources) {
    const MeshFile file = read_file(0);
    vertex_counts_ = vertex_counts(file);
    first_triangles_ = triangles_of(file);
}

MeshFile SequenceReader::read_file(std::size_t k) const {
    return read_mesh_file(files_.files[k], files_.names[k]);
}

void SequenceReader::check_same(const MeshFile& file, std::size_t k) const {
    const auto counts = vertex_counts(file);
    const auto triangles = triangles_of(file);
    if (counts == vertex_counts_ && triangles == first_triangles_) {
        return;
    }
    const bool same_totals = total(counts) == total(vertex_counts_) &&
                             triangle_count(triangles) == triangle_count(first_triangles_);
    fail_input(
        "{}: {} vertices and {} triangles{}, {} has {} and {}: must be the same mesh in each "
        "file",
        files_.names[k], total(counts), triangle_count(triangles),
        same_totals ? " that join others" : "", files_.names[0], total(vertex_counts_),
        triangle_count(first_triangles_));
}

void SequenceReader::read(std::size_t k, std::vector<Vec3f>& positions) const {
    const MeshFile file = read_file(k);
    check_same(file, k);
    positions.clear();
    for (const auto [object, vertex] : vertices_) {
        const Vec3& x = file.objects[static_cast<std::size_t>(object)]
                            .positions[static_cast<std::size_t>(vertex)];
        if (!x.allFinite()) {
            fail_input("{}: vertex {} has a coordinate that is not a finite number",
                       files_.names[k], vertex);
        }
        positions.push_back(x.cast<float>());
    }
}

} // namespace weft
