#pragma once

#include "collide/contact.h"
#include "collide/contact_surface.h"
#include "state/friction_history.h"

#include <span>
#include <vector>

namespace weft {

/// The friction history that contacts leave when a substep ends, sorted by pair.
/// @param start, end #V of World: where the substep began and ended, m
void remember(std::span<const Contact> contacts,
              std::span<const Vec3> start,
              std::span<const Vec3> end,
              std::vector<FrictionHistory>& history);

/// Gives the contacts of a substep the friction history of the one before.
class FrictionRecall {
public:
    /// Takes up the history, sorted by pair; it must stay as long as the other functions are
    /// called.
    void read(const ContactSurface& surface, std::span<const FrictionHistory> history);

    /// Sets slip and sliding of a contact, and returns the rest gap that its history gives it: its
    /// pair's own; or, of a pair that is new, that of the pairs which its vertices were in before,
    /// as a contact that moves on over the mesh continues the one beside it. Never less than its
    /// gap, never more than its thickness.
    double recall(const ContactSurface& surface, Contact& contact) const;

    /// Adds the transfers (transfer_key) to the slips of the contacts at their vertices.
    ///
    /// A new contact takes part in the transfers of its vertices that belong to the object which it
    /// touches, in proportion to the vertex's weight in it times its depth below its rest gap: as
    /// this much may friction hold. A transfer that any contact takes part in is given whole: the
    /// sum of weight times slip stays as it was, but for what leans out of the contacts' planes.
    void distribute(const ContactSurface& surface, std::span<Contact> contacts) const;

private:
    /// What the pairs that a vertex was in hand on to those that take over from them.
    struct VertexHistory {
        double rest_gap = 0.0; ///< greatest, m
        bool slides = false;
    };

    std::span<const FrictionHistory> history_;
    std::vector<VertexHistory> of_vertex_; ///< #V deformable
    bool has_transfers_ = false;
};

} // namespace weft
