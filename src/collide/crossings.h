#pragma once

#include "collide/contact.h"
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
    std::vector<std::array<Index, 2>> find(const ContactSurface& surface,
                                           std::span<const Vec3> positions);

private:
    bool self_;
    std::vector<Box> boxes_; ///< #triangles
    BoxTree deformables_, obstacles_;
    std::vector<BoxTree::Task> tasks_;
    std::vector<std::vector<std::array<Index, 2>>> found_; ///< a task
};

/// What is told of two triangles of the surface that cross at `positions`.
ContactProblem describe_crossing(const ContactSurface& surface,
                                 std::span<const Vec3> positions,
                                 const std::array<Index, 2>& pair);

/// The same search in a world as it stands: for tests and `--verify`, apart from the solver that it
/// checks. Follows the world's mesh as it changes.
class WorldCrossings {
public:
    WorldCrossings(const World& world, bool self);

    /// Pairs that cross at world.positions with the obstacles where they are at `time` (s); sorted.
    std::vector<ContactProblem> find(const World& world, double time);

private:
    bool self_;
    std::vector<Index> adaptations_; ///< of each cloth's mesh, when the surface was made
    ContactSurface surface_;
    CrossingSearch search_;
};

} // namespace weft
