#include "step/adapt_world.h"

#include "adapt/adaption_plan.h"
#include "adapt/coarseness.h"
#include "adapt/make_refinement.h"
#include "adapt/state_transfer.h"
#include "geometry/dihedral.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace weft {

namespace {

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

/// An inner edge of an imported shape that turns by more than this is a crease, rad. A flip across
/// it would put a stretched triangle over a fold that is meant to be there; smaller keeps edges of
/// round garments (a tube of six sides turns by 60 degrees) from flipping, which they should.
constexpr double k_crease = 65.0 * std::numbers::pi / 180.0;

/// A flip across a deeper fold (rad) waits until it is shallower: the rest shape is flat, and the
/// new triangles would be shorter across the fold than they rest, and stretched along it, by a few
/// percent at this angle and by half in slivers at a right angle.
constexpr double k_deep_fold = 20.0 * std::numbers::pi / 180.0;

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

/// The hooks by which the transfer of state takes part in the edits of a cloth.
AdaptionHooks make_hooks(StateTransfer& transfer, AdaptionReport& report) {
    AdaptionHooks hooks;
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

/// Are the folds across the edge that a flip takes away and across the one that it puts in shallow?
/// The second is the deeper one where a flip is taken back: to the long edge of flat triangles.
bool is_shallow(const StateTransfer& transfer, const EdgeFlip& flip) {
    const Vec3& a = transfer.position(flip.edge[0]);
    const Vec3& b = transfer.position(flip.edge[1]);
    const Vec3& p = transfer.position(flip.apex[0]);
    const Vec3& q = transfer.position(flip.apex[1]);
    return std::abs(dihedral_angle(a, b, p, q)) < k_deep_fold &&
           std::abs(dihedral_angle(p, q, b, a)) < k_deep_fold;
}

/// Of what moves the surface, lets only that be done that stretches no cloth and, where contact is
/// on, that it has room for.
void add_guard(AdaptionHooks& hooks,
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

/// Lets nothing be done that moves the surface.
void forbid_moves(AdaptionHooks& hooks) {
    hooks.may_flip = [](const EdgeFlip&) { return false; };
    hooks.may_remove = [](const Removal&) { return false; };
}

/// Too near for any triangle to be cut.
bool is_near_budget(const Cloth& cloth) {
    constexpr std::size_t k_most_added = 4; // by one cut
    return cloth.triangles.size() + k_most_added > at(cloth.params.adapt.max_triangles);
}

/// Carries out a plan. False: the budget of triangles was too short for it.
bool carry_out(const AdaptionPlan& plan, Sqrt3Mesh& mesh, Cloth& cloth, AdaptionHooks hooks) {
    const AdaptParams& params = cloth.params.adapt;
    mesh.begin(cloth, std::move(hooks),
               {.max_level = params.levels,
                .max_triangles = params.max_triangles,
                .adaption = cloth.refinement.adaptions});
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

StartPositions::StartPositions(const World& start) {
    auto next = start.positions.begin();
    for (const Cloth& cloth : start.cloths) {
        const auto end = next + cloth.vertex_count;
        cloths_.emplace_back(next, cloth.refinement.empty() ? end : next);
        next = end;
    }
    bodies_.assign(next, start.positions.end());
}

std::vector<Vec3> StartPositions::of(const World& world) const {
    std::vector<Vec3> start;
    start.reserve(world.vertex_count());
    for (std::size_t c = 0; c < cloths_.size(); ++c) {
        const Refinement& refinement = world.cloths[c].refinement;
        const std::vector<Vec3>& own = refinement.empty() ? cloths_[c] : refinement.start;
        start.insert(start.end(), own.begin(), own.end());
    }
    start.insert(start.end(), bodies_.begin(), bodies_.end());
    assert(start.size() == world.vertex_count());
    return start;
}

WorldAdaption::WorldAdaption(const World& world) : obstacles_(world) {
    reset(world);
}

void WorldAdaption::reset(const World& world) {
    meshes_.clear();
    for (const Cloth& cloth : world.cloths) {
        meshes_.push_back(cloth.refinement.empty() ? nullptr : std::make_unique<Sqrt3Mesh>(cloth));
    }
}

AdaptionReport WorldAdaption::adapt(World& world,
                                    double time,
                                    const ContactSolver& contact,
                                    std::vector<ClothChanges>& changes) {
    AdaptionReport report;
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

bool WorldAdaption::adapt_cloth(World& world,
                                std::size_t index,
                                double time,
                                EditGuard* guard,
                                ClothChanges& changes,
                                AdaptionReport& report) {
    Cloth& cloth = world.cloths[index];
    const AdaptParams& params = cloth.params.adapt;
    near_curvature_.clear();
    if (params.contact && params.curvature > 0.0 && !world.obstacles.empty()) {
        obstacles_.find(world, cloth, time, near_curvature_);
    }
    find_coarseness(cloth, world.positions_of(cloth), world.velocities_of(cloth), near_curvature_,
                    coarseness_);
    ++cloth.refinement.adaptions;
    const AdaptionPlan plan = plan_adaption(cloth, coarseness_);
    if (plan.empty() && cloth.refinement.pending_flips.empty()) {
        cloth.refinement.tolerance = next_tolerance(cloth.refinement.tolerance, false);
        return false;
    }

    const Cloth before = cloth;
    for (const bool may_move : {true, false}) {
        StateTransfer transfer(world, cloth);
        AdaptionReport done;
        AdaptionHooks hooks = make_hooks(transfer, done);
        if (!may_move) {
            forbid_moves(hooks);
        } else {
            add_guard(hooks, transfer, guard, index);
        }
        const bool suffices = carry_out(plan, *meshes_[index], cloth, std::move(hooks));
        changes = meshes_[index]->finish();
        if (may_move && guard != nullptr &&
            guard->crosses(static_cast<Index>(index), cloth, transfer.positions(cloth), changes)) {
            cloth = before; // edits side by side got into each other's way
            meshes_[index] = std::make_unique<Sqrt3Mesh>(cloth);
            continue;
        }
        cloth.refinement.tolerance = next_tolerance(cloth.refinement.tolerance, !suffices);
        if (!changes.empty()) {
            transfer.finish(world, index, changes);
        }
        report.refined += done.refined;
        report.coarsened += done.coarsened;
        break;
    }
    return !changes.empty();
}

} // namespace weft
