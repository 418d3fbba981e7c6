#pragma once

#include "frames/frame.h"
#include "frames/run_folder.h"
#include "scene/params.h"
#include "scene/pose.h"

#include <map>
#include <vector>

namespace weft {

/// An obstacle as it is kept for pictures: its mesh once, in its own frame and in the single
/// precision of the cache, and its motion. A live run and a run read back pose the same numbers by
/// the same code, so that they draw the same bytes.
/// One that deforms has its reach alone here: its positions stand in the cache frame by frame.
struct RigidShape {
    FrameObject shape; ///< name, own positions, triangles
    Vec3 origin;       ///< the placement's translation, m
    std::vector<PoseKey> motion;
};

/// The obstacle at time t (s).
FrameObject pose_shape(const RigidShape& rigid, double t);

/// Writes the obstacles of a run, once: rigid ones in their own frame, of the others their reach.
void write_obstacles(const RunPaths& paths, const std::vector<RigidShape>& obstacles);

/// Writes one PLY for each object of the frame that moves by forces and each obstacle that deforms.
void write_cache(const RunPaths& paths, const Frame& frame);

/// A run read from its cache alone: gives the frames that the simulation wrote, to the same bits,
/// without simulating. Safe while the run goes on.
class CachedRun {
public:
    /// @param folder of the run
    /// @param scene  what its scene.resolved.toml holds: names, fabrics, motions, fps
    /// Throws Error (Disk) in one line when an obstacle's file is missing or damaged.
    CachedRun(const std::filesystem::path& folder, const Scene& scene);

    /// Numbers of the frames in the cache that have a file for all that write_cache() writes,
    /// ascending.
    std::vector<int> frames() const;

    /// Frame `number`: cloths, solids, rigid bodies, obstacles, each in the scene's order.
    /// Throws Error (Disk) in one line when a file is missing or damaged.
    Frame read(int number) const;

private:
    RunPaths paths_;
    double fps_;
    /// What a cache of each frame was written of.
    struct Mover {
        std::string name;
        ObjectKind kind;
        std::string fabric;
    };
    FrameObject read_shape(const std::string& name, int number) const;
    FrameObject read_mover(const Mover& mover, int number) const;

    std::vector<Mover> movers_;
    std::vector<RigidShape> obstacles_;
    std::map<int, std::vector<Vec3f>> problems_; ///< by frame; empty unless the scene shows them
};

/// Time of frame n, s: the first is 0.
double frame_time(int frame, double fps);

} // namespace weft
