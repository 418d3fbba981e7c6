#include "frames/checkpoint.h"

#include "base/hash.h"
#include "frames/mesh_state.h"
#include "state/obstacle.h"

#include <fmt/core.h>
#include <zstd.h>

#include <bit>
#include <cassert>
#include <cstring>

namespace weft {

static_assert(std::endian::native == std::endian::little, "checkpoints are little-endian");

namespace {

constexpr std::array<char, 8> k_magic{'w', 'e', 'f', 't', 'c', 'k', 'p', 't'};
constexpr std::uint32_t k_version = 4; ///< another layout of the payload: another version
constexpr int k_level = 1;             ///< positions hardly compress; higher levels only cost time

/// Stands at the head of the file, no padding.
struct Header {
    std::array<char, 8> magic = k_magic;
    std::uint32_t version = k_version;
    std::int32_t frame = 0;
    std::uint64_t scene_hash = 0;
    double time = 0.0;
    double history_dt = 0.0;
    std::uint64_t vertices = 0;
    std::uint64_t attached_pairs = 0;
    std::uint64_t contacts = 0; ///< entries of the contact memory
    std::uint64_t mesh_bytes = 0;
    std::uint64_t compressed_bytes = 0;
    std::uint64_t checksum = 0; ///< covers this header with 0 here, then the compressed bytes
};
static_assert(sizeof(Header) == 88);

constexpr std::size_t k_vertex_bytes = 4 * sizeof(Vec3);
constexpr std::uint64_t k_most_vertices = 1ULL << 31; ///< an Index counts no further
constexpr std::uint64_t k_most_contacts = 1ULL << 33;
constexpr std::uint64_t k_most_mesh_bytes = 1ULL << 42;

std::uint64_t checksum(Header header, std::string_view compressed) {
    header.checksum = 0;
    Hash hash;
    hash.add(std::span<const Header>(&header, 1));
    hash.add(std::span<const char>(compressed));
    return hash.value();
}

const std::array<std::vector<Vec3> Checkpoint::*, 4> k_arrays{
    &Checkpoint::positions, &Checkpoint::velocities, &Checkpoint::previous_positions,
    &Checkpoint::previous_velocities};

std::string compress(const Checkpoint& checkpoint) {
    std::string state;
    state.reserve(checkpoint.positions.size() * k_vertex_bytes);
    for (const auto array : k_arrays) {
        const auto& values = checkpoint.*array;
        assert(values.size() == checkpoint.positions.size());
        state.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Vec3));
    }
    state.append(reinterpret_cast<const char*>(checkpoint.attached_states.data()),
                 checkpoint.attached_states.size() * sizeof(AttachedState));
    state.append(reinterpret_cast<const char*>(checkpoint.friction_history.data()),
                 checkpoint.friction_history.size() * sizeof(FrictionHistory));
    state.append(checkpoint.meshes);
    std::string compressed(ZSTD_compressBound(state.size()), '\0');
    const std::size_t bytes =
        ZSTD_compress(compressed.data(), compressed.size(), state.data(), state.size(), k_level);
    assert(!ZSTD_isError(bytes)); // the bound always suffices
    compressed.resize(bytes);
    return compressed;
}

bool decompress(std::string_view compressed, const Header& header, Checkpoint& out) {
    const std::size_t vertices = header.vertices;
    const std::size_t attached_bytes = header.attached_pairs * sizeof(AttachedState);
    const std::size_t contact_bytes = header.contacts * sizeof(FrictionHistory);
    const std::size_t sized = vertices * k_vertex_bytes + attached_bytes + contact_bytes;
    std::string state(sized + header.mesh_bytes, '\0');
    const std::size_t bytes =
        ZSTD_decompress(state.data(), state.size(), compressed.data(), compressed.size());
    if (ZSTD_isError(bytes) || bytes != state.size()) {
        return false;
    }
    const char* source = state.data();
    for (const auto array : k_arrays) {
        (out.*array).resize(vertices);
        std::memcpy(static_cast<void*>((out.*array).data()), source, vertices * sizeof(Vec3));
        source += vertices * sizeof(Vec3);
    }
    out.attached_states.resize(header.attached_pairs);
    if (attached_bytes > 0) {
        std::memcpy(out.attached_states.data(), source, attached_bytes);
    }
    out.friction_history.resize(header.contacts);
    if (contact_bytes > 0) {
        std::memcpy(static_cast<void*>(out.friction_history.data()), source + attached_bytes,
                    contact_bytes);
    }
    out.meshes = state.substr(sized);
    return true;
}

template <typename T> void add(Hash& hash, const std::vector<T>& values) {
    hash.add(std::span<const T>(values));
}

} // namespace

Checkpoint make_checkpoint(const World& world, std::uint64_t scene_hash) {
    return {.scene_hash = scene_hash,
            .frame = world.frame,
            .time = world.time,
            .history_dt = world.history_dt,
            .positions = world.positions,
            .velocities = world.velocities,
            .previous_positions = world.previous_positions,
            .previous_velocities = world.previous_velocities,
            .attached_states = world.attached_states,
            .friction_history = world.friction_history,
            .meshes = encode_meshes(world)};
}

void restore(const Checkpoint& checkpoint, World& world) {
    [[maybe_unused]] const std::string fault = decode_meshes(checkpoint.meshes, world);
    assert(fault.empty());
    assert(checkpoint.attached_states.size() == world.attached_states.size());
    world.frame = checkpoint.frame;
    world.time = checkpoint.time;
    world.history_dt = checkpoint.history_dt;
    world.positions = checkpoint.positions;
    world.velocities = checkpoint.velocities;
    world.previous_positions = checkpoint.previous_positions;
    world.previous_velocities = checkpoint.previous_velocities;
    world.attached_states = checkpoint.attached_states;
    world.friction_history = checkpoint.friction_history;
}

std::string encode_checkpoint(const Checkpoint& checkpoint) {
    const std::string compressed = compress(checkpoint);
    Header header;
    header.frame = checkpoint.frame;
    header.scene_hash = checkpoint.scene_hash;
    header.time = checkpoint.time;
    header.history_dt = checkpoint.history_dt;
    header.vertices = checkpoint.positions.size();
    header.attached_pairs = checkpoint.attached_states.size();
    header.contacts = checkpoint.friction_history.size();
    header.mesh_bytes = checkpoint.meshes.size();
    header.compressed_bytes = compressed.size();
    header.checksum = checksum(header, compressed);
    return std::string(reinterpret_cast<const char*>(&header), sizeof header) + compressed;
}

std::string decode_checkpoint(std::string_view bytes, Checkpoint& out) {
    Header header;
    if (bytes.size() < sizeof header) {
        return "truncated";
    }
    std::memcpy(&header, bytes.data(), sizeof header);
    const std::string_view compressed = bytes.substr(sizeof header);
    if (header.magic != k_magic) {
        return "not a checkpoint";
    }
    if (header.version != k_version) {
        return fmt::format("version {}, this program reads {}", header.version, k_version);
    }
    if (compressed.size() != header.compressed_bytes) {
        return "truncated";
    }
    if (checksum(header, compressed) != header.checksum || header.vertices > k_most_vertices ||
        header.attached_pairs > k_most_vertices || header.contacts > k_most_contacts ||
        header.mesh_bytes > k_most_mesh_bytes) {
        return "its checksum does not match";
    }
    out.scene_hash = header.scene_hash;
    out.frame = header.frame;
    out.time = header.time;
    out.history_dt = header.history_dt;
    return decompress(compressed, header, out) ? "" : "its state cannot be unpacked";
}

std::uint64_t geometry_hash(const World& start) {
    Hash hash;
    add(hash, start.positions);
    add(hash, start.velocities);
    add(hash, start.masses);
    for (const Cloth& cloth : start.cloths) {
        add(hash, cloth.triangles);
        add(hash, cloth.material_positions);
        for (const RestTriangle& rest : cloth.rest) {
            hash.add(std::span<const double>(rest.inverse_edges.data(), 4));
        }
    }
    for_each_body(start, [&](const Body& body) {
        add(hash, body.triangles);
        for (const Embedding& embedding : body.embeddings) {
            hash.add(std::span<const Index>(embedding.particles));
            hash.add(std::span<const double>(embedding.weights));
        }
    });
    for (const AttachedPair& pair : start.attached_pairs) {
        hash.add(std::span<const Index>(pair.vertices));
        hash.add(std::span<const double>(pair.weights));
    }
    for (const Obstacle& obstacle : start.obstacles) {
        add(hash, obstacle.mesh.positions);
        add(hash, obstacle.mesh.triangles);
        const std::uint64_t motion = deforms(obstacle) ? obstacle.deformation->fingerprint() : 0;
        hash.add(std::span<const std::uint64_t>(&motion, 1));
    }
    return hash.value();
}

} // namespace weft
