#pragma once

#include "collide/contact.h"
#include "collide/proximity.h"

namespace weft {

/// Finds where deformables stand against obstacles at the start of a substep.
class RestingSearch {
public:
    explicit RestingSearch(const ContactSurface& surface) : broad_phase_(surface, false) {}

    /// Makes the trees from where the surface stands; they only change their boxes later.
    void build_trees(const ContactSurface& surface) {
        broad_phase_.find(surface, 0.0, candidates_);
    }

    /// Places the surface (deformables without motion) and lists the contacts, in the order of the
    /// candidates.
    void find(ContactSurface& surface,
              const World& world,
              std::span<const char> held,
              double dt,
              std::vector<RestingContact>& resting);

private:
    BroadPhase broad_phase_; ///< that does not look for self-contact
    ProximitySearch proximity_search_;
    std::vector<Vec3> still_;
    std::vector<Candidate> candidates_;
    std::vector<ContactRow> rows_;
};

/// Tells the rows of pairs that the implicit solve carried what it did there. Such a pair may stand
/// a little inside the thickness, where the solve's push and the load balance, and is not asked to
/// part.
void credit_carried(const ContactSurface& surface,
                    std::span<const RestingContact> resting,
                    double dt,
                    std::span<ContactRow> rows);

} // namespace weft
