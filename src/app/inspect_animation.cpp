#include "app/inspect_animation.h"

#include "scene/mesh_sequence.h"
#include "state/build_obstacle.h"

#include <algorithm>

namespace weft {

namespace {

/// Places of the motion that are looked at for its extent.
constexpr int k_looks = 16;

std::string name_of(const Animation& animation) {
    return animation.name.empty() ? "(no name)" : fmt::format("\"{}\"", animation.name);
}

std::string size_text(const Eigen::AlignedBox3d& box) {
    return fmt::format("from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m", box.min().x(),
                       box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z());
}

} // namespace

void describe_animations(const Rig& rig, std::span<const std::size_t> chosen, SummaryLines& sheet) {
    std::vector<Index> bones;
    std::size_t targets = 0;
    for (const std::size_t i : chosen) {
        const RigPart& part = rig.parts[i];
        for (std::size_t b = 0; b + 1 < part.bones.size(); ++b) { // the last stands for none
            bones.push_back(part.bones[b].node);
        }
        targets += part.targets.size();
    }
    std::sort(bones.begin(), bones.end());
    bones.erase(std::unique(bones.begin(), bones.end()), bones.end());
    const char* label = "animations";
    for (const Animation& animation : rig.animations) {
        sheet.row(label, "{}: {:.4g} s, moves {}; {}, {}", name_of(animation), animation.duration,
                  plural(animation.channels.size(), "node"), plural(bones.size(), "bone"),
                  plural(targets, "morph target"));
        label = "";
    }
    for (const std::string& warning : rig.warnings) {
        sheet.row("warning", "{}", warning);
    }
}

void describe_deformation(const ObstacleParams& params,
                          const std::filesystem::path& base_dir,
                          const SceneParams& scene,
                          SummaryLines& sheet) {
    const Obstacle obstacle =
        build_obstacle(params, base_dir, scene.fps, [](const std::string&) {});
    if (!deforms(obstacle)) {
        return;
    }
    if (params.animation.is_sequence) {
        const std::size_t files = find_sequence(base_dir, params.mesh.file).files.size();
        sheet.row("sequence", "{}, {:.4g} a second", plural(files, "file"),
                  params.animation.fps > 0.0 ? params.animation.fps : scene.fps);
    }
    Eigen::AlignedBox3d box;
    const double end = (scene.frames - 1) / scene.fps;
    std::vector<Vec3> positions(obstacle.mesh.positions.size());
    for (int k = 0; k <= k_looks; ++k) {
        obstacle_positions(obstacle, end * k / k_looks, positions);
        for (const Vec3& x : positions) {
            box.extend(x);
        }
    }
    sheet.row("deforms", "over the scene {}", size_text(box));
}

} // namespace weft
