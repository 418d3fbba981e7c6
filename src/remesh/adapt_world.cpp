#include "remesh/adapt_world.h"

#include "adapt/adaptation_plan.h"
#include "adapt/coarseness.h"
#include "adapt/state_transfer.h"

#include <algorithm>

#include "remesh/absorb_gain.h"
#include "remesh/edit_rules.h"

namespace weft {

namespace {

/// The hooks by which the transfer of state takes part in the edits of a cloth.
AdaptationHooks make_hooks(StateTransfer& transfer, AdaptationReport& report) {
    AdaptationHooks hooks;
    hooks.insert = [&](const VertexParents& place) {
        transfer.insert(place);
        ++report.refined;
    };
    hooks.remove = [&](const VertexParents& place) {
        transfer.remove(place);
        ++report.coarsened;
    };
    hooks.move = [&](Index from, Index to) { transfer.move(from, to); };
    return hooks;
}

/// A vertex is shifted by so many contact thicknesses at most to let a gain of energy go.
constexpr double k_farthest_shift = 1.0;

/// What an adaptation did to the energy of a cloth's surface, and what then moved.
struct Absorbed {
    double energy = 0.0;          ///< change of elastic and gravity energy that is left, J
    std::vector<Index> vertices;  ///< shifted
    std::vector<Index> triangles; ///< around them, in no order
};

/// Lets a cloth give way to what an adaptation did to it, where that gave it energy; what is left
/// is taken off its motion.
Absorbed absorb_gains(const PlacedCloth& before,
                      const Cloth& cloth,
                      const Sqrt3Mesh& mesh,
                      const ClothChanges& changes,
                      const Vec3& gravity,
                      bool may_yield,
                      StateTransfer& transfer) {
    std::vector<Vec3> x = transfer.positions(cloth);
    std::vector<char> may_move;
    for (Index v = 0; v < cloth.vertex_count; ++v) {
        may_move.push_back(static_cast<char>(may_yield && transfer.is_free(v)));
    }
    BendElements bends(cloth);
    const YieldingCloth yielding{cloth,    mesh.stars(),
                                 bends,    gravity,
                                 may_move, k_farthest_shift * cloth.params.fabric.thickness,
                                 x};
    Absorbed absorbed;
    for (const ChangedPatch& patch : find_changed_patches(before, {cloth, x}, changes, gravity)) {
        double left = patch.gain;
        if (left > 0.0) {
            left = absorb_gain(yielding, patch, absorbed.vertices);
            transfer.charge(patch.vertices[0].vertex, std::max(0.0, left));
        }
        absorbed.energy += left;
    }
    std::vector<Index> star;
    for (const Index v : absorbed.vertices) {
        transfer.shift(v, x[at(v)]);
        mesh.stars().triangles_of(v, star);
        absorbed.triangles.insert(absorbed.triangles.end(), star.begin(), star.end());
    }
    return absorbed;
}

double kinetic_energy(const World& world, const Cloth& cloth) {
    double twice = 0.0;
    for (Index v = cloth.first_vertex; v < cloth.first_vertex + cloth.vertex_count; ++v) {
        twice += world.masses[at(v)] * world.velocities[at(v)].squaredNorm();
    }
    return 0.5 * twice;
}

/// Changes, and more triangles for whom they are to be looked at.
ClothChanges with_triangles(ClothChanges changes, const std::vector<Index>& more) {
    std::vector<Index>& all = changes.triangles;
    all.insert(all.end(), more.begin(), more.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return changes;
}

/// Too near for any triangle to be cut.
bool is_near_budget(const Cloth& cloth) {
    constexpr std::size_t k_most_added = 4; // by one cut
    return cloth.triangles.size() + k_most_added > at(cloth.params.adapt.max_triangles);
}

/// Carries out a plan. False: the budget of triangles was too short for it.
bool carry_out(const AdaptationPlan& plan, Sqrt3Mesh& mesh, Cloth& cloth, AdaptationHooks hooks) {
    const AdaptParams& params = cloth.params.adapt;
    mesh.begin(cloth, std::move(hooks),
               {.max_level = params.levels,
                .max_triangles = params.max_triangles,
                .adaptation = cloth.refinement.adaptations});
    mesh.retry_flips();
    bool suffices = true;
    for (const Index t : plan.refine) {
        if (mesh.can_refine(t) && !mesh.refine(t)) {
            suffices = suffices && !is_near_budget(cloth);
        }
    }
    for (const Index v : plan.remove) {
        if (mesh.can_remove(v)) {
            mesh.remove(v);
        }
    }
    return suffices;
}

} // namespace

AdaptationReport& AdaptationReport::operator+=(const AdaptationReport& other) {
    refined += other.refined;
    coarsened += other.coarsened;
    energy += other.energy;
    changed = changed || other.changed;
    return *this;
}

WorldAdaptation::WorldAdaptation(const World& world, const Vec3& gravity)
    : obstacles_(world), gravity_(gravity) {
    reset(world);
}

void WorldAdaptation::reset(const World& world) {
    meshes_.clear();
    for (const Cloth& cloth : world.cloths) {
        meshes_.push_back(cloth.refinement.empty() ? nullptr : std::make_unique<Sqrt3Mesh>(cloth));
    }
}

AdaptationReport WorldAdaptation::adapt(World& world,
                                        double time,
                                        const ContactSolver& contact,
                                        std::vector<ClothChanges>& changes) {
    AdaptationReport report;
    std::optional<EditGuard> guard = contact.guard_edits();
    changes.assign(world.cloths.size(), {});
    for (std::size_t c = 0; c < world.cloths.size(); ++c) {
        if (meshes_[c] != nullptr) {
            report.changed |=
                adapt_cloth(world, c, time, guard ? &*guard : nullptr, changes[c], report);
        }
    }
    return report;
}

bool WorldAdaptation::adapt_cloth(World& world,
                                  std::size_t index,
                                  double time,
                                  EditGuard* guard,
                                  ClothChanges& changes,
                                  AdaptationReport& report) {
    Cloth& cloth = world.cloths[index];
    const AdaptParams& params = cloth.params.adapt;
    near_curvature_.clear();
    if (params.contact && params.curvature > 0.0 && !world.obstacles.empty()) {
        obstacles_.find(world, cloth, time, near_curvature_);
    }
    find_coarseness(cloth, world.positions_of(cloth), world.velocities_of(cloth), near_curvature_,
                    coarseness_);
    ++cloth.refinement.adaptations;
    const AdaptationPlan plan = plan_adaptation(cloth, coarseness_);
    if (plan.empty() && cloth.refinement.pending_flips.empty()) {
        cloth.refinement.tolerance = next_tolerance(cloth.refinement.tolerance, false);
        return false;
    }

    const Cloth before = cloth;
    for (const bool may_move : {true, false}) {
        StateTransfer transfer(world, cloth);
        AdaptationReport done;
        AdaptationHooks hooks = make_hooks(transfer, done);
        if (!may_move) {
            forbid_moves(hooks);
        } else {
            add_guard(hooks, transfer, guard, index);
        }
        const bool suffices = carry_out(plan, *meshes_[index], cloth, std::move(hooks));
        changes = meshes_[index]->finish();
        const Absorbed absorbed =
            absorb_gains({before, world.positions_of(before)}, cloth, *meshes_[index], changes,
                         gravity_, may_move, transfer);
        if (may_move && guard != nullptr &&
            guard->crosses(static_cast<Index>(index), cloth, transfer.positions(cloth),
                           with_triangles(changes, absorbed.triangles))) {
            cloth = before; // edits side by side got into each other's way
            meshes_[index] = std::make_unique<Sqrt3Mesh>(cloth);
            continue;
        }
        cloth.refinement.tolerance = next_tolerance(cloth.refinement.tolerance, !suffices);
        if (!changes.empty()) {
            done.energy = absorbed.energy - kinetic_energy(world, before);
            transfer.finish(world, index, changes);
            done.energy += kinetic_energy(world, cloth);
        }
        report += done;
        break;
    }
    return !changes.empty();
}

} // namespace weft
