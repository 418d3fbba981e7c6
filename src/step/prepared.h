#pragma once

#include "state/world.h"

namespace weft {

/// A world at t = 0 as Stepper takes it, with the parameters of its simulation. All that is made of
/// it is the same whenever it is made, so that a resumed run goes on to the same bits: a run moves
/// a copy of the world. start/prepare.h makes one of a scene.
class Prepared {
public:
    /// Makes the cloths of a world adaptive that are to be refined. The world is as built, at t =
    /// 0; nothing in it crosses, unless the caller wants to see what comes of that.
    Prepared(World world, const SceneParams& scene, const ContactParams& contact);

    const World& world() const { return world_; }
    const SceneParams& scene() const { return scene_; }
    const ContactParams& contact() const { return contact_; }

private:
    World world_;
    SceneParams scene_;
    ContactParams contact_;
};

/// Positions at t = 0 of all vertices that forces move. Bounding volume trees are made of these, so
/// that they are the same whenever they are made.
class StartPositions {
public:
    /// @param start  the world at t = 0
    explicit StartPositions(const World& start);

    /// #V, m, by the present numbers of the vertices; refinement remembers those of adaptive
    /// cloths.
    std::vector<Vec3> of(const World& world) const;

private:
    std::vector<std::vector<Vec3>> cloths_; ///< positions; empty for adaptive cloths
    std::vector<Vec3> bodies_;              ///< vertices of all solids and rigid bodies
};

} // namespace weft
