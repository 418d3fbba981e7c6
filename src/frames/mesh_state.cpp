#include "frames/mesh_state.h"

#include "state/body.h"

#include <algorithm>
#include <cstring>

namespace weft {

namespace {

/// A pin without padding.
struct StoredPin {
    std::array<double, 9> places; ///< start, weights, offset
    std::array<Index, 4> numbers; ///< vertex, obstacle, triangle, group
};
static_assert(sizeof(StoredPin) == 88);

StoredPin pack(const Pin& pin) {
    StoredPin stored{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        stored.places[k] = pin.start[i];
        stored.places[3 + k] = pin.anchor.weights[i];
        stored.places[6 + k] = pin.anchor.offset[i];
    }
    stored.numbers = {pin.vertex, pin.anchor.obstacle, pin.anchor.triangle, pin.group};
    return stored;
}

Pin unpack(const StoredPin& stored) {
    const auto& p = stored.places;
    return {.vertex = stored.numbers[0],
            .start = {p[0], p[1], p[2]},
            .anchor = {.obstacle = stored.numbers[1],
                       .triangle = stored.numbers[2],
                       .weights = {p[3], p[4], p[5]},
                       .offset = {p[6], p[7], p[8]}},
            .group = stored.numbers[3]};
}

/// Arrays one after the other, each with its length before it.
class ByteWriter {
public:
    template <typename T> void put(std::span<const T> values) {
        const std::uint64_t count = values.size();
        bytes_.append(reinterpret_cast<const char*>(&count), sizeof count);
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    }
    template <typename T> void put(const std::vector<T>& values) { put(std::span(values)); }
    template <typename T> void put_one(const T& value) { put(std::span(&value, 1)); }

    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

class ByteReader {
public:
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

    template <typename T> void get(std::vector<T>& values) {
        std::uint64_t count = 0;
        if (!take(&count, sizeof count) || count > bytes_.size() / sizeof(T)) {
            failed_ = true;
            return;
        }
        values.resize(count);
        take(values.data(), count * sizeof(T));
    }
    template <typename T> void get_one(T& value) {
        std::vector<T> values;
        get(values);
        failed_ = failed_ || values.size() != 1;
        value = failed_ ? T{} : values[0];
    }

    bool is_whole() const { return !failed_ && bytes_.empty(); }

private:
    bool take(void* target, std::size_t size) {
        failed_ = failed_ || bytes_.size() < size;
        if (!failed_ && size > 0) {
            std::memcpy(target, bytes_.data(), size);
            bytes_.remove_prefix(size);
        }
        return !failed_;
    }

    std::string_view bytes_;
    bool failed_ = false;
};

/// Calls f with each array of a cloth that adaptation changes.
template <typename AnyCloth, typename F> void for_each_array(AnyCloth& cloth, const F& f) {
    f(cloth.triangles);
    f(cloth.topology.edges);
    f(cloth.topology.triangle_edges);
    f(cloth.rest);
    f(cloth.material_positions);
    f(cloth.rest_areas);
    f(cloth.refinement.triangles);
    f(cloth.refinement.vertices);
    f(cloth.refinement.locked);
    f(cloth.refinement.pending_flips);
    f(cloth.refinement.start);
}

bool is_adaptive(const Cloth& cloth) {
    return !cloth.refinement.empty();
}

/// Do the arrays read belong to one mesh, and to one refined from the imported one?
bool are_of_one_mesh(const Cloth& cloth) {
    const Refinement& refinement = cloth.refinement;
    const std::size_t vertices = cloth.rest_areas.size();
    const std::size_t triangles = cloth.triangles.size();
    const std::size_t edges = cloth.topology.edges.size();
    const auto imported = static_cast<std::size_t>(refinement.base_vertices);
    return vertices == imported + refinement.vertices.size() &&
           cloth.material_positions.size() == vertices && refinement.start.size() == vertices &&
           triangles >= static_cast<std::size_t>(refinement.base_triangles) &&
           cloth.topology.triangle_edges.size() == triangles && cloth.rest.size() == triangles &&
           refinement.triangles.size() == triangles &&
           edges >= static_cast<std::size_t>(refinement.base_edges) &&
           refinement.locked.size() == edges;
}

/// Vertices of later cloths and of bodies, and what names them, move along.
void set_first_vertices(World& world) {
    Index next = 0;
    Index old_end = 0; // end of all cloths' vertices, as they were
    for (Cloth& cloth : world.cloths) {
        const Index old = cloth.first_vertex;
        const Index shift = next - old;
        const Index imported =
            is_adaptive(cloth) ? cloth.refinement.base_vertices : cloth.vertex_count;
        for (AttachedPair& pair : world.attached_pairs) {
            for (Index& v : pair.vertices) {
                // Numbers of before; those moved already are marked below -1.
                v = v >= old && v < old + imported ? -2 - (v + shift) : v;
            }
        }
        old_end = old + imported;
        cloth.first_vertex = next;
        next += cloth.vertex_count;
    }
    number_bodies(world);
    for (AttachedPair& pair : world.attached_pairs) {
        for (Index& v : pair.vertices) {
            v = v < -1 ? -2 - v : v >= old_end ? v + next - old_end : v;
        }
    }
}

} // namespace

std::string encode_meshes(const World& world) {
    if (std::none_of(world.cloths.begin(), world.cloths.end(), is_adaptive)) {
        return "";
    }
    ByteWriter out;
    for (const Cloth& cloth : world.cloths) {
        if (is_adaptive(cloth)) {
            for_each_array(cloth, [&](const auto& values) { out.put(values); });
            out.put_one(cloth.refinement.adaptations);
            out.put_one(cloth.refinement.tolerance);
        }
    }
    out.put(world.masses);
    std::vector<StoredPin> pins(world.pins.size());
    std::transform(world.pins.begin(), world.pins.end(), pins.begin(), pack);
    out.put(pins);
    return out.take();
}

std::string decode_meshes(std::string_view bytes, World& world) {
    const bool none = std::none_of(world.cloths.begin(), world.cloths.end(), is_adaptive);
    if (none) {
        return bytes.empty() ? "" : "it has refined meshes, the scene has none";
    }
    ByteReader in(bytes);
    for (Cloth& cloth : world.cloths) {
        if (is_adaptive(cloth)) {
            for_each_array(cloth, [&](auto& values) { in.get(values); });
            in.get_one(cloth.refinement.adaptations);
            in.get_one(cloth.refinement.tolerance);
            cloth.vertex_count = static_cast<Index>(cloth.rest_areas.size());
        }
    }
    in.get(world.masses);
    std::vector<StoredPin> pins;
    in.get(pins);
    std::size_t vertices = 0;
    bool are_meshes = in.is_whole();
    for (const Cloth& cloth : world.cloths) {
        vertices += static_cast<std::size_t>(cloth.vertex_count);
        are_meshes = are_meshes && (!is_adaptive(cloth) || are_of_one_mesh(cloth));
    }
    for_each_body(world, [&](const Body& body) {
        vertices += static_cast<std::size_t>(body.vertex_count + body.particle_count);
    });
    if (!are_meshes || world.masses.size() != vertices) {
        return "its meshes cannot be unpacked";
    }
    set_first_vertices(world);
    world.pins.clear();
    for (const StoredPin& pin : pins) {
        world.pins.push_back(unpack(pin));
    }
    return "";
}

} // namespace weft
