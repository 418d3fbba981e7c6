#include "remesh/adapt_world.h"

#include "adapt/adaptation_plan.h"
#include "adapt/adaptive_cloth.h"
#include "adapt/state_transfer.h"
#include "geometry/curvature.h"
#include "remesh/relax_after_remesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {

namespace {

/// The hooks by which the transfer of state takes part in the edits of a cloth.
AdaptationHooks make_hooks(StateTransfer& transfer, AdaptationReport& report) {
    AdaptationHooks hooks;
    hooks.insert = [&](const VertexParents& position) {
        transfer.insert(position);
        ++report.refined;
    };
    hooks.remove = [&](const VertexParents& position) {
        transfer.remove(position);
        ++report.coarsened;
    };
    hooks.move = [&](Index from, Index to) { transfer.move(from, to); };
    return hooks;
}

/// A flip across a deeper fold (rad) waits until it is shallower: the rest shape is flat, and the
/// new triangles would be shorter across the fold than they rest, and stretched along it, by a few
/// percent at this angle and by half in slivers at a right angle.
constexpr double k_deep_fold = 20.0 * std::numbers::pi / 180.0;

/// The same where a vertex is fixed, by contact for example, and cannot relax (see
/// relax_after_remesh.h).
constexpr double k_deep_held_fold = 8.0 * std::numbers::pi / 180.0;

bool is_free(const StateTransfer& transfer, const EdgeFlip& flip) {
    return transfer.is_free(flip.edge[0]) && transfer.is_free(flip.edge[1]) &&
           transfer.is_free(flip.apex[0]) && transfer.is_free(flip.apex[1]);
}

/// Are the folds across the edge that a flip takes away and across the one that it puts in shallow?
/// The second is the deeper one where a flip is taken back: to the long edge of flat triangles.
bool is_shallow(const StateTransfer& transfer, const EdgeFlip& flip) {
    const Vec3& a = transfer.position(flip.edge[0]);
    const Vec3& b = transfer.position(flip.edge[1]);
    const Vec3& p = transfer.position(flip.apex[0]);
    const Vec3& q = transfer.position(flip.apex[1]);
    const double deepest = is_free(transfer, flip) ? k_deep_fold : k_deep_held_fold;
    return std::abs(dihedral_angle(a, b, p, q)) < deepest &&
           std::abs(dihedral_angle(p, q, b, a)) < deepest;
}

/// Allows an edit that moves the surface only where it stretches no cloth and, with contact on,
/// where the guard finds nothing in its way. All arguments must outlive the hooks.
/// @param guard  null: contact is off
/// @param cloth  number of the cloth
void add_guard(AdaptationHooks& hooks,
               const StateTransfer& transfer,
               EditGuard* guard,
               std::size_t cloth) {
    const auto may_sweep = [&transfer, guard, cloth](const std::array<Index, 4>& v) {
        return guard == nullptr ||
               guard->may_sweep(static_cast<Index>(cloth),
                                {transfer.position(v[0]), transfer.position(v[1]),
                                 transfer.position(v[2]), transfer.position(v[3])},
                                v);
    };
    const auto may_flip = [may_sweep, &transfer](const EdgeFlip& flip) {
        return is_shallow(transfer, flip) &&
               may_sweep({flip.edge[0], flip.edge[1], flip.apex[0], flip.apex[1]});
    };
    hooks.may_flip = may_flip;
    hooks.may_remove = [may_flip, may_sweep](const Removal& removal) {
        bool may = std::all_of(removal.flips.begin(), removal.flips.end(), may_flip);
        for (const VertexParents& gone : removal.vertices) {
            for (const Triangle& left : removal.merged) {
                may = may && may_sweep({gone.vertex, left[0], left[1], left[2]});
            }
        }
        return may;
    };
}

/// Allows no edit that moves the surface.
void forbid_moves(AdaptationHooks& hooks) {
    hooks.may_flip = [](const EdgeFlip&) { return false; };
    hooks.may_remove = [](const Removal&) { return false; };
}

/// Greatest shift of a vertex by relaxation, in contact thicknesses.
constexpr double k_farthest_shift = 1.0;

/// What is left of the energy that an adaptation gave a cloth after relaxation, and what moved.
struct Relaxed {
    double energy = 0.0;          ///< change of elastic and gravity energy that is left, J
    std::vector<Index> vertices;  ///< shifted
    std::vector<Index> triangles; ///< around them, in no order
};

/// Relaxes the patches of a cloth that gained energy by an adaptation. Gain that is left is charged
/// to the transfer, which takes it off the motion.
Relaxed relax_patches(const PlacedCloth& before,
                      const Cloth& cloth,
                      const Sqrt3Mesh& mesh,
                      const ClothChanges& changes,
                      const Vec3& gravity,
                      bool may_relax,
                      StateTransfer& transfer) {
    std::vector<Vec3> x = transfer.positions(cloth);
    std::vector<char> may_move;
    for (Index v = 0; v < cloth.vertex_count; ++v) {
        may_move.push_back(static_cast<char>(may_relax && transfer.is_free(v)));
    }
    BendElements bends(cloth);
    const RelaxationContext context{cloth,    mesh.stars(),
                                    bends,    gravity,
                                    may_move, k_farthest_shift * cloth.params.fabric.thickness,
                                    x};
    Relaxed relaxed;
    for (const ChangedPatch& patch : find_changed_patches(before, {cloth, x}, changes, gravity)) {
        double left = patch.gain;
        if (left > 0.0) {
            left = relax_after_remesh(context, patch, relaxed.vertices);
            transfer.charge(patch.vertices[0].vertex, std::max(0.0, left));
        }
        relaxed.energy += left;
    }
    std::vector<Index> star;
    for (const Index v : relaxed.vertices) {
        transfer.shift(v, x[at(v)]);
        mesh.stars().triangles_of(v, star);
        relaxed.triangles.insert(relaxed.triangles.end(), star.begin(), star.end());
    }
    return relaxed;
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
    remesh(world);
}

void WorldAdaptation::remesh(const World& world) {
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
    find_refinement_indicator(cloth, world.positions_of(cloth), world.velocities_of(cloth),
                              near_curvature_, indicator_);
    ++cloth.refinement.adaptations;
    const AdaptationPlan plan = plan_adaptation(cloth, indicator_);
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
        const Relaxed relaxed =
            relax_patches({before, world.positions_of(before)}, cloth, *meshes_[index], changes,
                          gravity_, may_move, transfer);
        if (may_move && guard != nullptr &&
            guard->crosses(static_cast<Index>(index), cloth, transfer.positions(cloth),
                           with_triangles(changes, relaxed.triangles))) {
            cloth = before; // edits side by side got into each other's displacement
            meshes_[index] = std::make_unique<Sqrt3Mesh>(cloth);
            continue;
        }
        cloth.refinement.tolerance = next_tolerance(cloth.refinement.tolerance, !suffices);
        if (!changes.empty()) {
            done.energy = relaxed.energy - kinetic_energy(world, before);
            transfer.finish(world, index, changes);
            done.energy += kinetic_energy(world, cloth);
        }
        report += done;
        break;
    }
    return !changes.empty();
}

namespace {

/// An inner edge of an imported shape that turns by more than this is a crease, rad. A flip across
/// it would put a stretched triangle over a fold that is meant to be there; smaller keeps edges of
/// round garments (a tube of six sides turns by 60 degrees) from flipping, which they should.
constexpr double k_crease = 65.0 * std::numbers::pi / 180.0;

/// Where cloth rests as imported, its creases are part of its shape.
void lock_creases(const World& world, Cloth& cloth) {
    if (cloth.params.rest != RestShape::Mesh) {
        return;
    }
    const auto x = world.positions_of(cloth);
    for (std::size_t e = 0; e < cloth.topology.edges.size(); ++e) {
        const MeshEdge& edge = cloth.topology.edges[e];
        if (!edge.is_boundary() &&
            std::abs(dihedral_angle(x[at(edge.v[0])], x[at(edge.v[1])], x[at(edge.apex[0])],
                                    x[at(edge.apex[1])])) > k_crease) {
            cloth.refinement.locked[e] = 1;
        }
    }
}

void freeze_attached(World& world, Cloth& cloth) {
    std::vector<char> attached(at(cloth.vertex_count), 0);
    for (const AttachedPair& pair : world.attached_pairs) {
        for (const Index v : pair.vertices) {
            if (v >= cloth.first_vertex && v < cloth.first_vertex + cloth.vertex_count) {
                attached[at(v - cloth.first_vertex)] = 1;
            }
        }
    }
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        for (const Index v : cloth.triangles[t]) {
            cloth.refinement.frozen[t] |= static_cast<std::uint8_t>(attached[at(v)]);
        }
    }
}

} // namespace

void make_adaptive(World& world) {
    for (Cloth& cloth : world.cloths) {
        if (cloth.params.adapt.levels > 0 && cloth.refinement.empty()) {
            make_refinement(cloth);
            const auto x = world.positions_of(cloth);
            cloth.refinement.start.assign(x.begin(), x.end());
            lock_creases(world, cloth);
            freeze_attached(world, cloth);
        }
    }
}

} // namespace weft
