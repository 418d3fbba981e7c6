#pragma once

#include "adapt/obstacle_curvature.h"
#include "adapt/sqrt3_mesh.h"
#include "collide/contact.h"

#include <memory>
#include <vector>

namespace weft {

/// Makes the meshes of all cloths that are to be refined adaptive. Of a world at t = 0, as it will
/// start; creases of imported shapes and triangles with an attached vertex are kept.
void make_adaptive(World& world);

/// What an adaption did.
struct AdaptionReport {
    int refined = 0, coarsened = 0; ///< vertices put in, and taken out
    bool changed = false;           ///< any mesh
};

/// The end of a substep: refines and coarsens all adaptive cloths for what they do now, and carries
/// the world's state over. Results depend on the world alone.
class WorldAdaption {
public:
    /// @param world  at any time; the obstacles' shapes are those at t = 0
    explicit WorldAdaption(const World& world);

    /// @param time     of the world's state, s
    /// @param contact  has just resolved the substep
    /// @param changes  of each cloth
    AdaptionReport adapt(World& world,
                         double time,
                         const ContactSolver& contact,
                         std::vector<ClothChanges>& changes);

    /// Forgets the meshes known: the world's are others now.
    void reset(const World& world);

private:
    bool adapt_cloth(World& world,
                     std::size_t index,
                     double time,
                     EditGuard* guard,
                     ClothChanges& changes,
                     AdaptionReport& report);

    ObstacleCurvature obstacles_;
    std::vector<std::unique_ptr<Sqrt3Mesh>> meshes_; ///< of each cloth; null: not adaptive
    std::vector<double> near_curvature_, coarseness_;
};

/// Where the vertices of all that moves by forces were at t = 0: trees made of these places are the
/// same whenever they are made, so that a resumed run goes on to the same bits.
class StartPositions {
public:
    /// @param start  the world at t = 0
    explicit StartPositions(const World& start);

    /// #V, m, by the numbers that vertices have now; those of adaptive cloths as refinement
    /// remembers them.
    std::vector<Vec3> of(const World& world) const;

private:
    std::vector<std::vector<Vec3>> cloths_; ///< positions; none of adaptive ones
    std::vector<Vec3> bodies_;              ///< of all solids and rigid bodies
};

} // namespace weft
