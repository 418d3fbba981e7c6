#include "scene/mesh_import.h"

#include "base/error.h"
#include "scene/key.h"
#include "scene/mesh_assembly.h"

#include <algorithm>

namespace weft {
namespace {

bool is_called(const FileObject& object, const std::string& wanted) {
    return object.name == wanted || object.mesh_name == wanted ||
           std::find(object.parents.begin(), object.parents.end(), wanted) != object.parents.end();
}

void add_once(std::vector<std::string>& names, const std::string& name) {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
    }
}

std::vector<std::string> object_names(const MeshFile& file) {
    std::vector<std::string> names;
    for (const FileObject& object : file.objects) {
        add_once(names, object.name);
    }
    return names;
}

std::vector<std::string> all_names(const MeshFile& file) {
    std::vector<std::string> names = object_names(file);
    for (const FileObject& object : file.objects) {
        add_once(names, object.mesh_name);
        for (const std::string& parent : object.parents) {
            add_once(names, parent);
        }
    }
    return names;
}

/// "Box", "Sphere" and 3 more
std::string list_names(const std::vector<std::string>& names) {
    constexpr std::size_t k_listed = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), k_listed); ++i) {
        text += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", names[i]);
    }
    return names.size() > k_listed ? fmt::format("{} and {} more", text, names.size() - k_listed)
                                   : text;
}

} // namespace

std::vector<std::size_t>
choose_objects(const MeshFile& file, std::span<const std::string> wanted, const std::string& name) {
    for (const std::string& w : wanted) {
        const bool found = std::any_of(file.objects.begin(), file.objects.end(),
                                       [&](const FileObject& o) { return is_called(o, w); });
        if (!found) {
            fail_input("{}: object = \"{}\": not in the file; nearest is \"{}\" (it has {})", name,
                       w, nearest_key(w, all_names(file)), list_names(object_names(file)));
        }
    }
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < file.objects.size(); ++i) {
        const bool is_wanted =
            wanted.empty() || std::any_of(wanted.begin(), wanted.end(), [&](const std::string& w) {
                return is_called(file.objects[i], w);
            });
        if (is_wanted) {
            chosen.push_back(i);
        }
    }
    return chosen;
}

namespace {

/// Nodes that a channel moves, and all below them.
std::vector<char> moved_nodes(const Rig& rig, const Animation& animation) {
    std::vector<char> moved(rig.nodes.size(), 0);
    for (const NodeChannel& channel : animation.channels) {
        moved[at(channel.node)] = 1;
    }
    for (std::size_t i = 0; i < moved.size(); ++i) {
        if (rig.nodes[i].parent != k_no_index && moved[at(rig.nodes[i].parent)]) {
            moved[i] = 1;
        }
    }
    return moved;
}

/// "Run", "Walk"
std::string list_names(const std::vector<Animation>& animations) {
    std::string text;
    for (const Animation& animation : animations) {
        text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", animation.name);
    }
    return text;
}

} // namespace

bool animates(const Rig& rig, const Animation& animation, std::span<const SourceVertex> vertices) {
    const std::vector<char> moved = moved_nodes(rig, animation);
    std::vector<char> part_moves;
    for (const RigPart& part : rig.parts) {
        part_moves.push_back(moved[at(part.node)]);
        for (const Bone& bone : part.bones) {
            part_moves.back() = part_moves.back() || moved[at(bone.node)];
        }
    }
    for (const MorphChannel& channel : animation.morphs) {
        part_moves[at(channel.part)] = 1;
    }
    return std::any_of(vertices.begin(), vertices.end(), [&](const SourceVertex& vertex) {
        return part_moves[at(vertex.object)] != 0;
    });
}

const Animation*
choose_animation(const ImportedMesh& mesh, const std::string& wanted, const std::string& file) {
    if (wanted == "none" || (!mesh.rig && wanted.empty())) {
        return nullptr;
    }
    if (!mesh.rig) {
        fail_input("{}: animation = \"{}\": the file has no animations", file, wanted);
    }
    const std::vector<Animation>& animations = mesh.rig->animations;
    const auto found = wanted.empty()
                           ? animations.begin()
                           : std::find_if(animations.begin(), animations.end(),
                                          [&](const Animation& a) { return a.name == wanted; });
    if (found == animations.end()) {
        fail_input("{}: animation = \"{}\": not in the file; it has {}", file, wanted,
                   list_names(animations));
    }
    return animates(*mesh.rig, *found, mesh.sources) ? &*found : nullptr;
}

ImportedMesh import_mesh(const std::filesystem::path& file, const MeshSource& source, bool cloth) {
    const std::string name = source.file.empty() ? file.string() : source.file;
    const MeshFile read = read_mesh_file(file, name);
    MeshAssembly assembly =
        assemble_mesh(read, choose_objects(read, source.objects, name), source, name);
    if (cloth) {
        assembly.refusals.insert(assembly.refusals.end(), assembly.cloth_refusals.begin(),
                                 assembly.cloth_refusals.end());
    }
    if (assembly.refusals.size() == 1) {
        fail_input("{}", assembly.refusals[0]);
    }
    if (!assembly.refusals.empty()) {
        fail_input("{} (and {} more: see weft inspect)", assembly.refusals[0],
                   assembly.refusals.size() - 1);
    }
    return std::move(assembly.imported);
}

} // namespace weft
