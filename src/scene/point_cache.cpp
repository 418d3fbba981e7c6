#include "scene/point_cache.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "geometry/weld.h"
#include "scene/mesh_assembly.h"
#include "scene/text_scan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

namespace weft {

static_assert(std::endian::native == std::endian::little, "point caches are read as such");

namespace {

constexpr std::string_view k_pc2_magic("POINTCACHE2\0", 12);

/// Numbers one after the other; after the end of the file all are 0 and is_whole() is false.
class NumberStream {
public:
    NumberStream(std::ifstream& stream, bool is_big_endian)
        : stream_(stream), is_big_endian_(is_big_endian) {}

    std::int32_t integer() { return std::bit_cast<std::int32_t>(word()); }
    float number() { return std::bit_cast<float>(word()); }
    bool is_whole() const { return static_cast<bool>(stream_); }

private:
    std::uint32_t word() {
        std::uint32_t bits = 0;
        stream_.read(reinterpret_cast<char*>(&bits), sizeof bits);
        return is_big_endian_ ? __builtin_bswap32(bits) : bits;
    }

    std::ifstream& stream_;
    bool is_big_endian_;
};

std::string lower_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::uintmax_t sample_bytes(const PointCache& cache) {
    return 3 * sizeof(float) * static_cast<std::uintmax_t>(cache.points);
}

void set_counts(PointCache& cache, std::int32_t samples, std::int32_t points) {
    if (samples < 1 || points < 1) {
        fail_input("{}: says it has {} samples of {} points: must be 1 or more", cache.name,
                   samples, points);
    }
    cache.samples = static_cast<std::size_t>(samples);
    cache.points = static_cast<std::size_t>(points);
}

/// Before anything is made as large as the header asks for.
void check_size(const PointCache& cache, std::uintmax_t bytes) {
    const std::uintmax_t needed =
        cache.first_byte + static_cast<std::uintmax_t>(cache.samples) * sample_bytes(cache);
    if (bytes < needed) {
        fail_input("{}: truncated: {} samples of {} points need {} bytes, it has {}", cache.name,
                   cache.samples, cache.points, needed, bytes);
    }
}

void read_pc2(std::ifstream& stream, std::uintmax_t bytes, double fps, PointCache& cache) {
    std::string magic(k_pc2_magic.size(), '\0');
    stream.read(magic.data(), static_cast<std::streamsize>(magic.size()));
    NumberStream numbers(stream, false);
    const std::int32_t version = numbers.integer();
    const std::int32_t points = numbers.integer();
    numbers.number(); // the first frame: the first sample is where the animation starts
    const double rate = numbers.number();
    const std::int32_t samples = numbers.integer();
    if (magic != k_pc2_magic || (numbers.is_whole() && version != 1)) {
        fail_input("{}: does not begin as a PC2 point cache of version 1", cache.name);
    }
    if (!numbers.is_whole()) {
        fail_input("{}: truncated: its header is not whole", cache.name);
    }
    set_counts(cache, samples, points);
    if (!std::isfinite(rate) || rate <= 0.0) {
        fail_input("{}: says that a sample is {} frames: must be > 0", cache.name, rate);
    }
    cache.first_byte = k_pc2_magic.size() + 5 * sizeof(std::int32_t);
    check_size(cache, bytes);
    for (std::size_t k = 0; k < cache.samples; ++k) {
        cache.times.push_back(static_cast<double>(k) * rate / fps);
    }
}

void read_mdd(std::ifstream& stream, std::uintmax_t bytes, double fps, PointCache& cache) {
    NumberStream numbers(stream, true);
    const std::int32_t samples = numbers.integer();
    const std::int32_t points = numbers.integer();
    if (!numbers.is_whole()) {
        fail_input("{}: truncated: its header is not whole", cache.name);
    }
    set_counts(cache, samples, points);
    cache.first_byte = 2 * sizeof(std::int32_t) + cache.samples * sizeof(float);
    check_size(cache, bytes);
    for (std::size_t k = 0; k < cache.samples; ++k) {
        const double time = numbers.number();
        cache.times.push_back(fps > 0.0 ? static_cast<double>(k) / fps : time);
        if (!std::isfinite(time) || (k > 0 && cache.times[k] <= cache.times[k - 1])) {
            fail_input("{}: sample {} is at {} s: must be later than the one before (or set "
                       "sequence_fps)",
                       cache.name, k, time);
        }
    }
}

} // namespace

PointCache
open_point_cache(const std::filesystem::path& file, const std::string& name, double fps) {
    PointCache cache{.file = file, .name = name, .times = {}};
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file, error);
    std::ifstream stream(file, std::ios::binary);
    if (error || !stream) {
        fail_input("{}: {}", name, error ? error.message() : "cannot be opened for reading");
    }
    const std::string extension = lower_extension(file);
    if (extension == ".pc2") {
        read_pc2(stream, bytes, fps, cache);
    } else if (extension == ".mdd") {
        cache.is_big_endian = true;
        read_mdd(stream, bytes, fps, cache);
    } else {
        fail_input("{}: a point cache must end in .pc2 or .mdd", name);
    }
    return cache;
}

std::vector<Vec3f> read_sample(const PointCache& cache, std::size_t k) {
    std::ifstream stream(cache.file, std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(cache.first_byte + k * sample_bytes(cache)));
    std::vector<std::uint32_t> words(3 * cache.points);
    stream.read(reinterpret_cast<char*>(words.data()),
                static_cast<std::streamsize>(words.size() * sizeof(std::uint32_t)));
    if (!stream) {
        fail_disk("{}: sample {} cannot be read: the file has changed", cache.name, k);
    }
    std::vector<Vec3f> positions(cache.points);
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::uint32_t bits = cache.is_big_endian ? __builtin_bswap32(words[i]) : words[i];
        positions[i / 3][static_cast<Eigen::Index>(i % 3)] = std::bit_cast<float>(bits);
        if (!std::isfinite(std::bit_cast<float>(bits))) {
            fail_input("{}: sample {}: point {} has a coordinate that is not a finite number",
                       cache.name, k, i / 3);
        }
    }
    return positions;
}

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
    const Weld weld = weld_vertices(all, 2.0 * k_weld_fraction * bounding_diagonal(all));
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
