#include "scene/animation_choice.h"

#include "base/error.h"

#include <algorithm>

namespace weft {

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

} // namespace weft
