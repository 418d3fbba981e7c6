#include "state/build_obstacle.h"

#include "base/error.h"
#include "base/parallel.h"
#include "geometry/shapes.h"
#include "scene/mesh_import.h"
#include "scene/mesh_sequence.h"
#include "scene/point_cache.h"
#include "scene/rig_pose.h"
#include "scene/vertex_frames.h"

#include <algorithm>

namespace weft {

namespace {

TriangleMesh make_shape(const ObstacleParams& params) {
    switch (params.shape) {
    case Shape::Sphere:
        return sphere_mesh(params.radius);
    case Shape::Box:
        return box_mesh(params.size);
    default:
        return plane_mesh(params.size);
    }
}

std::shared_ptr<const Deformation> deform_by_rig(const ImportedMesh& imported,
                                                 const Animation& animation,
                                                 const AnimationParams& params,
                                                 const Mat3& to_frame) {
    const auto evaluate = [rig = imported.rig, &animation, vertices = imported.sources, params,
                           to_frame](double t, std::span<Vec3> positions) {
        pose_vertices(*rig, animation, time_in_animation(params, animation.duration, t), vertices,
                      positions);
        parallel_for(positions.size(), [&](std::size_t i) {
            const Vec3 x = positions[i];
            positions[i] = to_frame * x;
        });
    };
    return std::make_shared<Deformation>(imported.mesh.positions.size(),
                                         fingerprint(*imported.rig, animation), evaluate);
}

std::shared_ptr<const Deformation> deform_by_frames(const std::shared_ptr<VertexFrames>& frames,
                                                    std::size_t vertices,
                                                    const AnimationParams& params,
                                                    const Mat3& to_frame) {
    const auto evaluate = [frames, params, to_frame](double t, std::span<Vec3> positions) {
        frames->positions_at(time_in_animation(params, frames->duration(), t), to_frame, positions);
    };
    return std::make_shared<Deformation>(vertices, frames->fingerprint(), evaluate);
}

std::shared_ptr<VertexFrames> frames_of_sequence(SequenceFiles files,
                                                 const MeshSource& source,
                                                 const ImportedMesh& first,
                                                 double fps) {
    std::vector<double> times;
    for (std::size_t k = 0; k < files.files.size(); ++k) {
        times.push_back(static_cast<double>(k) / fps);
    }
    return std::make_shared<VertexFrames>(
        times, [reader = SequenceReader(std::move(files), source, first)](
                   std::size_t k, std::vector<Vec3f>& positions) { reader.read(k, positions); });
}

std::shared_ptr<VertexFrames> frames_of_cache(const ObstacleParams& params,
                                              const std::filesystem::path& base_dir,
                                              const ImportedMesh& imported,
                                              double fps) {
    const std::string& name = params.animation.cache;
    const bool own_times =
        params.animation.fps == 0.0 && std::filesystem::path(name).extension() != ".pc2";
    const PointCache cache = open_point_cache(base_dir / name, name, own_times ? 0.0 : fps);
    const std::vector<Index> order =
        cache_order(base_dir / params.mesh.file, params.mesh, imported, cache.points, name);
    return std::make_shared<VertexFrames>(
        cache.times, [cache, order](std::size_t k, std::vector<Vec3f>& positions) {
            const std::vector<Vec3f> points = read_sample(cache, k);
            positions.clear();
            for (const Index point : order) {
                positions.push_back(points[static_cast<std::size_t>(point)]);
            }
        });
}

/// The mesh file of an obstacle and what deforms it.
class ObstacleLoader {
public:
    ObstacleLoader(const ObstacleParams& params,
                   const std::filesystem::path& base_dir,
                   double fps,
                   const std::function<void(const std::string&)>& warn)
        : params_(params), base_dir_(base_dir),
          fps_(params.animation.fps > 0.0 ? params.animation.fps : fps), warn_(warn) {}

    void load(Obstacle& obstacle) {
        SequenceFiles files;
        MeshSource source = params_.mesh;
        std::filesystem::path file = base_dir_ / source.file;
        if (params_.animation.is_sequence) {
            files = find_sequence(base_dir_, params_.mesh.file);
            file = files.files[0];
            source.file = files.names[0];
        }
        ImportedMesh imported = import_mesh(file, source, false);
        tell(imported.warnings);
        obstacle.mesh = imported.mesh;
        const Mat3 to_frame = rotation_from_degrees(params_.placement.rotate_deg) *
                              params_.placement.scale * imported.to_world;
        obstacle.deformation =
            params_.animation.is_sequence
                ? by_frames(frames_of_sequence(files, source, imported, fps_), imported, to_frame)
            : !params_.animation.cache.empty()
                ? by_frames(frames_of_cache(params_, base_dir_, imported, fps_), imported, to_frame)
                : by_animation(imported, to_frame);
    }

private:
    std::shared_ptr<const Deformation> by_frames(const std::shared_ptr<VertexFrames>& frames,
                                                 const ImportedMesh& imported,
                                                 const Mat3& to_frame) const {
        return deform_by_frames(frames, imported.sources.size(), params_.animation, to_frame);
    }

    std::shared_ptr<const Deformation> by_animation(const ImportedMesh& imported,
                                                    const Mat3& to_frame) const {
        const Animation* animation =
            choose_animation(imported, params_.animation.name, params_.mesh.file);
        if (animation == nullptr) {
            return nullptr;
        }
        tell(imported.rig->warnings);
        return deform_by_rig(imported, *animation, params_.animation, to_frame);
    }

    void tell(const std::vector<std::string>& warnings) const {
        for (const std::string& line : warnings) {
            warn_(fmt::format("obstacle '{}': {}", params_.name, line));
        }
    }

    const ObstacleParams& params_;
    const std::filesystem::path& base_dir_;
    double fps_; ///< of sequences and caches
    const std::function<void(const std::string&)>& warn_;
};

} // namespace

Obstacle build_obstacle(const ObstacleParams& params,
                        const std::filesystem::path& base_dir,
                        double fps,
                        const std::function<void(const std::string&)>& warn) {
    Obstacle obstacle;
    obstacle.name = params.name;
    obstacle.params = params;
    obstacle.origin = params.placement.translate;
    if (params.shape == Shape::Mesh) {
        ObstacleLoader(params, base_dir, fps, warn).load(obstacle);
    } else {
        obstacle.mesh = make_shape(params);
    }
    if (deforms(obstacle)) {
        obstacle.mesh.positions = *obstacle.deformation->at(0.0);
    } else {
        for (Vec3& x : obstacle.mesh.positions) {
            x = place({Vec3::Zero(), params.placement.rotate_deg, params.placement.scale}, x);
        }
    }
    if (!std::all_of(obstacle.mesh.positions.begin(), obstacle.mesh.positions.end(),
                     [](const Vec3& x) { return x.allFinite(); })) {
        fail_input("{}: its animation gives coordinates that are not finite numbers",
                   params.mesh.file);
    }
    obstacle.topology = build_edges(obstacle.mesh.triangles);
    return obstacle;
}

} // namespace weft
