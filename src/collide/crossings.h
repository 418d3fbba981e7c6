#pragma once

#include "base/parallel.h"
#include "collide/contact_report.h"
#include "collide/contact_surface.h"
#include "geometry/box_tree.h"

namespace weft {

/// Do two triangles of the surface cross at `positions`? Those that share a corner, or are sewn
/// together in one, only where they do beyond it. Exact.
bool triangles_cross(const ContactSurface& surface,
                     Index s,
                     Index t,
                     std::span<const Vec3> positions);

/// Exact search for crossing triangles; keeps its trees between calls.
class CrossingSearch {
public:
    /// @param self whether deformables are tested against each other and themselves
    CrossingSearch(const ContactSurface& surface, bool self);

    /// Pairs of triangles of the surface that cross at `positions` (#V of the surface), at least
    /// one of them deformable; sorted, each with its lower number first.
    std::vector<TrianglePair> find(const ContactSurface& surface, std::span<const Vec3> positions);

private:
    bool self_;
    std::vector<Box> boxes_; ///< #triangles
    BoxTree deformables_, obstacles_;
    std::vector<BoxTree::Task> tasks_;
    ChunkLists<TrianglePair> tasks_found_;
};

/// The same search in a world as it stands: for tests and `--verify`, apart from the solver that it
/// checks. Follows the world's mesh as it changes.
class WorldCrossings {
public:
    WorldCrossings(const World& world, bool self);

    /// Pairs that cross at world.positions with the obstacles where they are at `time` (s); sorted.
    std::vector<UnresolvedPair> find(const World& world, double time);

private:
    bool self_;
    std::vector<Index> mesh_revisions_; ///< those that the surface was made of
    ContactSurface surface_;
    CrossingSearch search_;
};

/// All pairs of crossing triangles at world.time where at least one is a deformable's, by the exact
/// discrete test; sorted. At most `limit` of them.
std::vector<UnresolvedPair> find_crossings(const World& world, std::size_t limit);

} // namespace weft
