#pragma once

#include "collide/broad_phase.h"

namespace weft {

/// Vertices of deformables that an obstacle has caught on its wrong side, after a pinch left no
/// room. Contact with that obstacle would hold them there for ever; it yields, and they are drawn
/// out through the nearest place of the surface. Only closed obstacles have an inside.
class Tangled {
public:
    /// Looks at surface.start. @param crossings pairs of its triangles that cross there
    void find(const ContactSurface& surface, std::span<const std::array<Index, 2>> crossings);

    bool empty() const { return caught_.empty(); }

    /// Leaves out pairs of a caught vertex with the obstacle that has caught it.
    void drop_pairs(const ContactSurface& surface, std::vector<Candidate>& candidates) const;

    /// Gives vertices inside of one obstacle at least the speed outwards that brings them to its
    /// surface, or k_drawing_speed; those inside of several have no way to go yet.
    void draw_out(ContactSurface& surface, double dt) const;

private:
    struct Caught {
        Index obstacle;           ///< of ContactSurface::objects
        std::vector<char> flags;  ///< #V deformable: inside, or of a triangle pierced without that
        std::vector<char> inside; ///< #V deformable
    };
    std::vector<Caught> caught_;
};

} // namespace weft
