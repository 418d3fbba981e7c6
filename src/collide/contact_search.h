#pragma once

#include "base/parallel.h"
#include "collide/contact.h"
#include "collide/friction_history.h"
#include "collide/impact_zones.h"

#include <optional>

namespace weft {

/// Is the connection of a pair the shortest one there, seen from the whole surfaces? A vertex that
/// slides over a face is near to the sides of the next face too; such a connection leans, and would
/// brake the vertex. True when no triangle beside the closest points comes nearer, and for one of
/// the several pairs that have the same closest points.
bool is_nearest_here(const ContactSurface& surface,
                     const Candidate& candidate,
                     const Separation& place);

/// Where a pair stands when it is nearer than its reach and nearest there, else nothing.
std::optional<Separation> near_place(const ContactSurface& surface, const Candidate& candidate);

/// Makes what the implicit solve carries of pairs that are near, or that meet.
class ContactSearch {
public:
    /// Contacts of all pairs that are near at the start, in the order of the candidates, with what
    /// `history` (sorted by pair) knows of them.
    ///
    /// A pair pushes from the thickness inwards. One that is nearer when it is first seen pushes
    /// only from where it is, and its rest gap grows to the thickness by a tenth of what is missing
    /// a substep, k_parting_rate of it a second: cloth that starts in the skin comes out slowly.
    void find(const ContactSurface& surface,
              std::span<const Candidate> candidates,
              std::span<const FrictionHistory> history,
              double dt,
              std::vector<Contact>& contacts);

private:
    FrictionRecall recall_;
    ChunkLists<Contact> chunks_;
};

/// The contact of a pair that meets at time `toi` of the substep, seen as it stands then: the sides
/// may come as near as the thickness, or no nearer when they start inside it.
Contact make_impact_contact(const ContactSurface& surface,
                            const Candidate& candidate,
                            double toi,
                            double dt);

/// What keeps impulses from pressing together what the solve has kept apart.
ContactRow guard_row(const Contact& contact, double dt);

} // namespace weft
