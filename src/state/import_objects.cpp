#include "state/import_objects.h"

#include "base/parallel.h"
#include "geometry/shapes.h"
#include "scene/mesh_import.h"
#include "scene/mesh_sequence.h"
#include "scene/point_cache.h"
#include "scene/pose.h"
#include "scene/rig_pose.h"
#include "scene/vertex_frames.h"

#include <fmt/core.h>

#include <numeric>

namespace weft {

namespace {

void warn_of(const char* kind,
             const std::string& name,
             const std::vector<std::string>& warnings,
             const Warn& warn) {
    for (const std::string& line : warnings) {
        warn(fmt::format("{} '{}': {}", kind, name, line));
    }
}

/// A mesh of one of the kinds that must be manifold.
template <typename Params>
ImportedMesh import_file(const char* kind,
                         const Params& params,
                         const std::filesystem::path& base_dir,
                         const Warn& warn) {
    ImportedMesh imported = import_mesh(base_dir / params.mesh.file, params.mesh, true);
    warn_of(kind, params.name, imported.warnings, warn);
    return imported;
}

/// The mesh of a shape with keys `shape`, `radius` and `size`.
template <typename Params> TriangleMesh make_shape(const Params& params) {
    switch (params.shape) {
    case Shape::Sphere:
        return sphere_mesh(params.radius);
    case Shape::Box:
        return box_mesh(params.size);
    default:
        return plane_mesh(params.size);
    }
}

ImportedMesh make_grid(const ClothParams& params) {
    ImportedMesh grid;
    grid.mesh = grid_mesh(params.grid_size, params.grid_cells);
    const Vec2 half = 0.5 * params.grid_size;
    for (const Triangle& t : grid.mesh.triangles) {
        grid.polygons.push_back(static_cast<Index>(grid.polygons.size() / 2));
        auto& uv = grid.corner_uv.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& x = grid.mesh.positions[static_cast<std::size_t>(t[k])];
            uv[k] = Vec2(x.x() + half.x(), half.y() - x.z());
        }
    }
    return grid;
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
                   const Warn& warn)
        : params_(params), base_dir_(base_dir),
          fps_(params.animation.fps > 0.0 ? params.animation.fps : fps), warn_(warn) {}

    ImportedObstacle load() {
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
        const Mat3 to_frame = rotation_from_degrees(params_.placement.rotate_deg) *
                              params_.placement.scale * imported.to_world;
        std::shared_ptr<const Deformation> deformation =
            params_.animation.is_sequence
                ? by_frames(frames_of_sequence(files, source, imported, fps_), imported, to_frame)
            : !params_.animation.cache.empty()
                ? by_frames(frames_of_cache(params_, base_dir_, imported, fps_), imported, to_frame)
                : by_animation(imported, to_frame);
        return {std::move(imported.mesh), std::move(deformation)};
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
        warn_of("obstacle", params_.name, warnings, warn_);
    }

    const ObstacleParams& params_;
    const std::filesystem::path& base_dir_;
    double fps_; ///< frame rate of sequences and caches
    const Warn& warn_;
};

} // namespace

ImportedMesh
import_cloth(const ClothParams& params, const std::filesystem::path& base_dir, const Warn& warn) {
    return params.mesh.file.empty() ? make_grid(params)
                                    : import_file("cloth", params, base_dir, warn);
}

ImportedMesh
import_solid(const SolidParams& params, const std::filesystem::path& base_dir, const Warn& warn) {
    return params.mesh.file.empty() ? ImportedMesh{} : import_file("solid", params, base_dir, warn);
}

ImportedMesh
import_rigid(const RigidParams& params, const std::filesystem::path& base_dir, const Warn& warn) {
    return params.shape == Shape::Mesh ? import_file("rigid", params, base_dir, warn)
                                       : ImportedMesh{.mesh = make_shape(params)};
}

ImportedObstacle import_obstacle(const ObstacleParams& params,
                                 const std::filesystem::path& base_dir,
                                 double fps,
                                 const Warn& warn) {
    return params.shape == Shape::Mesh ? ObstacleLoader(params, base_dir, fps, warn).load()
                                       : ImportedObstacle{.mesh = make_shape(params)};
}

ImportedMesh imported(const Sheet& sheet) {
    ImportedMesh imported;
    for (const Vec2& p : sheet.points) {
        imported.mesh.positions.emplace_back(p.x(), p.y(), 0.0);
    }
    imported.mesh.triangles = sheet.triangles;
    imported.polygons.resize(sheet.triangles.size());
    std::iota(imported.polygons.begin(), imported.polygons.end(), 0);
    return imported;
}

} // namespace weft
