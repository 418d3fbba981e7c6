#pragma once

#include "collide/contact_row.h"

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

/// Rows of all pairs that are now nearer than their reach and nearest there, in the order of the
/// candidates.
class ProximitySearch {
public:
    void find(const ContactSurface& surface,
              std::span<const Candidate> candidates,
              double dt,
              std::vector<ContactRow>& rows);

private:
    std::vector<std::vector<ContactRow>> found_; ///< a chunk of candidates
};

} // namespace weft
