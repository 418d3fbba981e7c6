#pragma once

#include "collide/contact_search.h"
#include "collide/contact_solver.h"
#include "collide/crossings.h"
#include "collide/impact_zones.h"

// The stages of contact in one substep, after Bridson et al. 2002, Harmon et al. 2008 and Provot
// 1997:
//
// 1. The implicit solve carries the pairs that are near, or that its motion makes meet
//    (contact_search.h).
// 2. Impacts that are left get impulses, pair by pair, all impacts so far in each round.
// 3. Zones: what still meets is solved together with the pairs of 1, until it fits.
// 4. The fail-safe scales down the motion of zones that still do not fit (impact_zones.h), which
//    comes to an end.
//
// Whatever is accepted was tested: no candidate that a vertex of changed velocity belongs to is
// left out of the last search. The search keeps a smaller distance in stage 4 than before it, so
// that rounding at the limit does not send resting pairs there.

namespace weft {

/// The distance that impacts keep before the fail-safe, and in it.
inline constexpr ImpactLimit k_impulse_limit{.thickness_fraction = 0.3, .start_fraction = 0.8};
inline constexpr ImpactLimit k_final_limit{.thickness_fraction = 0.1, .start_fraction = 0.5};

struct ContactSolver::Impl {
    ContactParams params;
    ContactSurface surface;
    BroadPhase broad_phase;
    ContactSearch contact_search;
    ImpactSearch impact_search;
    CrossingSearch crossing_search;
    ImpactZones zones;

    std::vector<Candidate> candidates;
    std::vector<ContactRow> guard_rows,
        impact_rows; ///< rows of what the solve carried; rows of impacts
    std::vector<Impact> impacts;
    std::vector<char> look;            ///< #V of the surface: changed since the last search
    std::vector<Vec3> solved_velocity; ///< #V of the surface: before impulses
    std::vector<Vec3> ends;            ///< #V of the surface: positions after the substep

    /// Positions (all of the surface) that are known to be free of crossings: before and after the
    /// last substep.
    std::vector<Vec3> clean_start, clean_end;

    bool clean_motion = false; ///< the surface's motion was searched and meets nothing
    double seconds_broad = 0.0, seconds_proximity = 0.0,
           seconds_impact = 0.0; ///< wall time in this substep, s

    Impl(const World& world, const ContactParams& contact);

    /// Whether what moves by forces is looked at against itself: bodies always are.
    bool meets_self() const { return params.self || !surface.bodies.empty(); }

    ContactReport resolve(double dt, std::span<const Contact> contacts);
    void find_candidates(double dt);
    void guard(std::span<const Contact> contacts, double dt, ContactReport& report);
    bool find_impacts(double dt, std::vector<Contact>& contacts);
    int resolve_impacts(double dt, ContactReport& report);
    bool pass_of_impulses(int pass, double dt, ContactReport& report);
    int scale_zones(double dt, ContactReport& report);
    bool stop_cloths(double dt);
    void find_all_impacts(double dt);
    void accept_unresolved();
    void count_zones(ContactReport& report);
    void measure_end(double dt, bool clean_before, int left, ContactReport& report);
    bool is_clean_start();
    void count_contact(const std::array<Index, 4>& vertices, ContactReport& report) const;
};

} // namespace weft
