#pragma once

#include "adapt/adaptation_plan.h"
#include "adapt/sqrt3_mesh.h"
#include "collide/contact_solver.h"
#include "state/world.h"

#include <memory>
#include <vector>

namespace weft {

/// What an adaptation did.
struct AdaptationReport {
    int refined = 0, coarsened = 0; ///< vertices inserted and removed
    double energy = 0.0;            ///< change of kinetic, elastic and gravity energy, J
    bool changed = false;           ///< any mesh

    AdaptationReport& operator+=(const AdaptationReport& other);
};

/// Refines and coarsens all adaptive cloths at the end of a substep, by what they do then, and
/// transfers the world's state to the new meshes. Results depend on the world alone.
class WorldAdaptation {
public:
    /// @param world    at any time; the obstacles' shapes are those at t = 0
    /// @param gravity  m/s^2
    WorldAdaptation(const World& world, const Vec3& gravity);

    /// @param time     at which the world's state stands, s
    /// @param contact  has just resolved the substep
    /// @param changes  receives the changes of each cloth
    AdaptationReport adapt(World& world,
                           double time,
                           const ContactSolver& contact,
                           std::vector<ClothChanges>& changes);

    /// Follows a world whose meshes others have changed.
    void remesh(const World& world);

private:
    bool adapt_cloth(World& world,
                     std::size_t index,
                     double time,
                     EditGuard* guard,
                     ClothChanges& changes,
                     AdaptationReport& report);

    ObstacleCurvature obstacles_;
    Vec3 gravity_;
    std::vector<std::unique_ptr<Sqrt3Mesh>> meshes_; ///< by cloth; null: not adaptive
    std::vector<double> near_curvature_, indicator_;
};

/// Makes the meshes of all cloths that are to be refined adaptive. The world is the one that the
/// run starts from, at t = 0; creases of imported shapes and triangles with an attached vertex are
/// kept.
void make_adaptive(World& world);

} // namespace weft
