#pragma once

#include "collide/contact.h"
#include "collide/contact_search.h"
#include "collide/crossings.h"
#include "collide/impact.h"
#include "collide/islands.h"
#include "collide/proximity.h"

// The stages of one substep, methods of Bridson et al. 2002, Harmon et al. 2008 and Provot 1997:
//
// 1. pairs that are near or meet are carried by the implicit solve (contact_search.h); without it
//    proximities are set right with friction, at the start positions, to convergence;
// 2. impacts of the straight motion: impulses pair by pair, all impacts so far in each round;
// 3. zones: what is still met is solved together with the pairs of 1, until it fits;
// 4. islands that still do not fit are cut back (islands.h), which ends.
//
// Whatever is accepted was tested: no candidate that a vertex of changed velocity belongs to is
// left out of the last search. The search keeps a smaller distance in stage 4 than before it, so
// that rounding at the limit does not send resting pairs there.

namespace weft {

/// What impacts keep apart before the last resort, and in it.
inline constexpr ImpactLimit k_impulse_limit{.thickness_share = 0.3, .start_share = 0.8};
inline constexpr ImpactLimit k_final_limit{.thickness_share = 0.1, .start_share = 0.5};

struct ContactSolver::Impl {
    ContactParams params;
    ContactSurface surface;
    BroadPhase broad_phase;
    ContactSearch contact_search;
    ProximitySearch proximity_search;
    ImpactSearch impact_search;
    CrossingSearch crossing_search;
    Islands islands;
    std::vector<std::string> warnings;

    std::vector<Candidate> candidates;
    std::vector<ContactRow> proximities, impact_rows;
    std::vector<Impact> impacts;
    std::vector<char> look;            ///< #V of the surface: changed since the last search
    std::vector<Vec3> solved_velocity; ///< #V of the surface: before impulses
    std::vector<Vec3> ends;            ///< #V of the surface: positions after the substep

    /// Positions (all of the surface) that are known to be free of crossings: before and after the
    /// last substep.
    std::vector<Vec3> clean_start, clean_end;

    bool clean_motion = false; ///< the surface's motion was searched and meets nothing
    double seconds_broad = 0.0, seconds_proximity = 0.0, seconds_impact = 0.0; ///< of the substep

    Impl(const World& world, const ContactParams& contact);

    /// Whether what moves by forces is looked at against itself: bodies always are.
    bool meets_self() const { return params.self || !surface.bodies.empty(); }

    ContactReport resolve(double dt, std::optional<std::span<const Contact>> contacts);
    void find_candidates(double dt);
    void settle_proximities(double dt, ContactReport& report);
    void guard(std::span<const Contact> contacts, double dt, ContactReport& report);
    bool find_impacts(double dt, std::vector<Contact>& contacts);
    int resolve_impacts(double dt, ContactReport& report);
    bool pass_of_impulses(int pass, double dt, ContactReport& report);
    int cut_back_rest(double dt, ContactReport& report);
    bool stop_cloths(double dt);
    void find_all_impacts(double dt);
    void yield();
    void count_zones(ContactReport& report);
    void measure_end(double dt, bool clean_before, int left, ContactReport& report);
    bool is_clean_start();
    void count_contact(const std::array<Index, 4>& vertices, ContactReport& report) const;
};

} // namespace weft
