#include "base/stopwatch.h"
#include "collide/contact_stages.h"

namespace weft {

namespace {

/// Rounds of the last resort: in the first, islands keep a part of their motion.
constexpr int k_soft_cuts = 6;
constexpr int k_cuts = 64;

} // namespace

/// Where obstacles leave no room, contact gives way: the islands that still meet go on as they came
/// from the solve, whose springs push from all sides, rather than with what impulses made of it.
void ContactSolver::Impl::yield() {
    std::vector<char> meets(at(surface.deformable_vertices), 0);
    for (const Impact& impact : impacts) {
        for (const Index v : candidates[at(impact.candidate)].vertices) {
            if (surface.inverse_mass[at(v)] > 0.0) {
                meets[at(islands.of(v))] = 1;
            }
        }
    }
    for (Index v = 0; v < surface.deformable_vertices; ++v) {
        if (meets[at(islands.of(v))]) {
            surface.velocity[at(v)] = solved_velocity[at(v)];
        }
    }
}

/// Islands in a jam can push each other on without end. Then the cloths that they are of stand
/// still for this substep, which meets nothing where obstacles and held vertices leave them room.
/// False: they do not, and all is as it was.
bool ContactSolver::Impl::stop_cloths(double dt) {
    const std::vector<Vec3> moving = surface.velocity;
    std::vector<char> stands(surface.objects.size(), 0);
    while (!impacts.empty()) {
        bool more = false;
        for (const Impact& impact : impacts) {
            for (const Index v : candidates[at(impact.candidate)].vertices) {
                char& stand = stands[at(surface.object_of_vertex[at(v)])];
                more = more || (surface.inverse_mass[at(v)] > 0.0 && !stand);
                stand = stand || surface.inverse_mass[at(v)] > 0.0;
            }
        }
        if (!more) {
            surface.velocity = moving;
            find_all_impacts(dt);
            return false;
        }
        for (Index v = 0; v < surface.deformable_vertices; ++v) {
            if (surface.inverse_mass[at(v)] > 0.0 && stands[at(surface.object_of_vertex[at(v)])]) {
                surface.velocity[at(v)].setZero();
            }
        }
        find_all_impacts(dt);
    }
    return true;
}

/// Impacts of the present motion, whatever was searched before.
void ContactSolver::Impl::find_all_impacts(double dt) {
    find_candidates(dt);
    look.assign(surface.start.size(), 1);
    impact_search.find(surface, candidates, look, dt, k_final_limit, impacts);
}

/// Cuts back islands until nothing is met; returns the impacts that are left.
int ContactSolver::Impl::cut_back_rest(double dt, ContactReport& report) {
    islands.reset(surface);
    for (int round = 0;; ++round) {
        if (!broad_phase.covers(surface, dt)) {
            find_candidates(dt);
        }
        const Stopwatch watch;
        impact_search.find(surface, candidates, look, dt, k_final_limit, impacts);
        if (impacts.empty()) {
            return 0;
        }
        if (round == k_cuts) {
            if (stop_cloths(dt)) {
                return 0;
            }
            yield();
            return static_cast<int>(impacts.size());
        }
        std::fill(look.begin(), look.end(), 0);
        for (const Impact& impact : impacts) {
            islands.join(surface, candidates[at(impact.candidate)].vertices);
            for (const Index v : candidates[at(impact.candidate)].vertices) {
                look[at(v)] = 1;
            }
        }
        const int cut = cut_back(surface, candidates, impacts, islands,
                                 round < k_soft_cuts ? 1.0 : 0.0, dt, look);
        report.scaled_islands = std::max(report.scaled_islands, cut);
        report.seconds_impact += watch.seconds();
    }
}

} // namespace weft
