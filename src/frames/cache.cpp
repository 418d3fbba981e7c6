#include "frames/cache.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parallel.h"
#include "frames/ply.h"
#include "frames/problems.h"

#include <algorithm>
#include <charconv>

namespace weft {

namespace {

constexpr const char* k_about_cloth = "; u v is the rest position, m";

/// The frame number in "NAME.0012.ply", or 0.
int frame_number(const std::string& file, const std::string& name) {
    const std::string_view rest(file);
    if (!rest.starts_with(name + ".") || !rest.ends_with(".ply") ||
        rest.size() <= name.size() + 5) {
        return 0;
    }
    const std::string_view digits = rest.substr(name.size() + 1, rest.size() - name.size() - 5);
    int number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return error == std::errc() && end == digits.data() + digits.size() ? number : 0;
}

std::vector<int> frames_of(const RunPaths& paths, const std::string& name) {
    std::vector<int> numbers;
    std::error_code ignored; // no folder: no frames
    for (const auto& entry : std::filesystem::directory_iterator(paths.cache_dir(), ignored)) {
        if (const int number = frame_number(entry.path().filename().string(), name)) {
            numbers.push_back(number);
        }
    }
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

} // namespace

FrameObject pose_shape(const RigidShape& rigid, double t) {
    FrameObject posed = rigid.shape;
    Pose pose = pose_at(rigid.motion, t);
    pose.translation += rigid.origin;
    parallel_for(posed.positions.size(), [&](std::size_t i) {
        posed.positions[i] = (pose * rigid.shape.positions[i].cast<double>()).cast<float>();
    });
    return posed;
}

double frame_time(int frame, double fps) {
    return (frame - 1) / fps;
}

void write_obstacles(const RunPaths& paths, const std::vector<RigidShape>& obstacles) {
    for (const RigidShape& rigid : obstacles) {
        if (!rigid.shape.reach.empty()) {
            write_atomically(paths.reach(rigid.shape.name),
                             encode_ply({.positions = rigid.shape.reach},
                                        "weft: points that a deforming obstacle gets to, m"));
            continue;
        }
        write_atomically(paths.obstacle(rigid.shape.name),
                         encode_ply(rigid.shape, "weft: an obstacle in its own frame, m; its "
                                                 "motion is in scene.resolved.toml"));
    }
}

void write_cache(const RunPaths& paths, const Frame& frame) {
    for (const FrameObject& object : frame.objects) {
        const bool is_cloth = object.kind == ObjectKind::Cloth;
        if (object.kind != ObjectKind::Obstacle || !object.reach.empty()) {
            write_atomically(
                paths.shape(object.name, frame.number),
                encode_ply(object, fmt::format("weft: frame {}, time {} s{}", frame.number,
                                               frame.time, is_cloth ? k_about_cloth : "")));
        }
    }
}

CachedRun::CachedRun(const std::filesystem::path& folder, const Scene& scene)
    : paths_{folder}, fps_(scene.scene.fps) {
    for (const ClothParams& cloth : scene.cloths) {
        movers_.push_back({cloth.name, ObjectKind::Cloth, cloth.fabric.name});
    }
    for (const SolidParams& solid : scene.solids) {
        movers_.push_back({solid.name, ObjectKind::Solid, ""});
    }
    for (const RigidParams& rigid : scene.rigids) {
        movers_.push_back({rigid.name, ObjectKind::Rigid, ""});
    }
    for (const ObstacleParams& obstacle : scene.obstacles) {
        const bool is_deforming = std::filesystem::exists(paths_.reach(obstacle.name));
        const auto file =
            is_deforming ? paths_.reach(obstacle.name) : paths_.obstacle(obstacle.name);
        obstacles_.push_back({.shape = decode_ply(read_file(file), file.string()),
                              .origin = obstacle.placement.translate,
                              .motion = obstacle.motion});
        FrameObject& shape = obstacles_.back().shape;
        shape.name = obstacle.name;
        if (is_deforming) {
            shape.reach = std::move(shape.positions);
        }
    }
    if (const auto file = paths_.problems();
        scene.render.problems && std::filesystem::exists(file)) {
        problems_ = problem_places(parse_csv(read_file(file), file.string()), file.string());
    }
}

std::vector<int> CachedRun::frames() const {
    std::vector<std::string> names;
    for (const Mover& mover : movers_) {
        names.push_back(mover.name);
    }
    for (const RigidShape& obstacle : obstacles_) {
        if (!obstacle.shape.reach.empty()) {
            names.push_back(obstacle.shape.name);
        }
    }
    std::vector<int> common;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::vector<int> numbers = frames_of(paths_, names[i]);
        std::vector<int> both;
        std::set_intersection(common.begin(), common.end(), numbers.begin(), numbers.end(),
                              std::back_inserter(both));
        common = i == 0 ? numbers : both;
    }
    return common;
}

FrameObject CachedRun::read_shape(const std::string& name, int number) const {
    const auto file = paths_.shape(name, number);
    FrameObject object = decode_ply(read_file(file), file.string());
    object.name = name;
    return object;
}

FrameObject CachedRun::read_mover(const Mover& mover, int number) const {
    FrameObject object = read_shape(mover.name, number);
    if (mover.kind == ObjectKind::Cloth && object.kind != ObjectKind::Cloth) {
        fail_disk("{}: no 'u' and 'v': not a cloth that weft wrote",
                  paths_.shape(mover.name, number).string());
    }
    object.kind = mover.kind;
    object.fabric = mover.fabric;
    return object;
}

Frame CachedRun::read(int number) const {
    Frame frame{.number = number, .time = frame_time(number, fps_), .objects = {}};
    for (const Mover& mover : movers_) {
        frame.objects.push_back(read_mover(mover, number));
    }
    for (const RigidShape& obstacle : obstacles_) {
        if (obstacle.shape.reach.empty()) {
            frame.objects.push_back(pose_shape(obstacle, frame.time));
        } else {
            frame.objects.push_back(read_shape(obstacle.shape.name, number));
            frame.objects.back().reach = obstacle.shape.reach;
        }
    }
    if (const auto problems = problems_.find(number); problems != problems_.end()) {
        frame.problems = problems->second;
    }
    return frame;
}

} // namespace weft
