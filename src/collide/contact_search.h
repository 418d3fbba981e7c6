#pragma once

#include "collide/contact.h"
#include "collide/impact.h"
#include "collide/legacy_shares.h"

namespace weft {

/// Makes what the implicit solve carries of pairs that are near, or that meet.
class ContactSearch {
public:
    /// Contacts of all pairs that are near at the start, in the order of the candidates, with what
    /// `memory` (sorted by pair) knows of them.
    ///
    /// A pair pushes from the thickness inwards. One that is nearer when it is first seen pushes
    /// only from where it is, and its rest gap grows to the thickness by a tenth of what is missing
    /// a substep, k_parting_rate of it a second: cloth that starts in the skin comes out slowly. A
    /// pair that takes over from one beside it, as cloth slides on, takes over its rest gap and
    /// that it slides; where the mesh was adapted, also its part of the legacies there.
    void find(const ContactSurface& surface,
              std::span<const Candidate> candidates,
              std::span<const ContactMemory> memory,
              double dt,
              std::vector<Contact>& contacts);

private:
    /// What the pairs that a vertex was in hand on to those that take over from them.
    struct VertexMemory {
        double rest = 0.0; ///< greatest, m
        bool slides = false;
    };

    void note_vertices(const ContactSurface& surface, std::span<const ContactMemory> memory);
    void recall(const ContactSurface& surface,
                std::span<const ContactMemory> memory,
                double dt,
                Contact& contact) const;

    std::vector<VertexMemory> of_vertex_; ///< #V deformable
    bool has_legacies_ = false;
    LegacyShares shares_;
    std::vector<std::vector<Contact>> found_; ///< a chunk of candidates
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
