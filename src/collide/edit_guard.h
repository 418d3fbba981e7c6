#pragma once

#include "collide/broad_phase.h"
#include "state/cloth_changes.h"

namespace weft {

/// Says which local edits of a cloth's mesh leave contact as it is. An edit sweeps a tetrahedron;
/// it is let be made where that stays clear of all surfaces, as they were before the first edit,
/// but for the triangles at its own vertices, and of what other edits swept.
///
/// Lives from one substep's contact to the mesh's change; what it was made of must stay meanwhile.
class EditGuard {
public:
    /// @param ends  #V of the surface: where the last substep ended, m
    EditGuard(const ContactSurface& surface,
              const BroadPhase& broad_phase,
              std::span<const Vec3> ends)
        : surface_(surface), broad_phase_(broad_phase), ends_(ends) {}

    /// May a cloth's surface sweep this tetrahedron? When it may, it is taken as done.
    /// @param object    number of the cloth
    /// @param corners   m
    /// @param vertices  of the cloth; those that it did not have at first are told by their number
    bool may_sweep(Index object,
                   const std::array<Vec3, 4>& corners,
                   const std::array<Index, 4>& vertices);

    /// Does a triangle that edits changed cross any other one? Exact: the last word on all edits,
    /// also on those side by side.
    /// @param positions  #V of the cloth as it is now, m
    bool crosses(Index object,
                 const Cloth& cloth,
                 std::span<const Vec3> positions,
                 const ClothChanges& changes) const;

private:
    struct Swept {
        Index object;
        Box box;
        std::array<Index, 4> vertices;
    };

    bool is_clear_of(Index triangle,
                     Index object,
                     const std::array<Vec3, 4>& corners,
                     const std::array<Index, 4>& vertices) const;
    bool
    is_clear_of_edits(Index object, const Box& box, const std::array<Index, 4>& vertices) const;

    const ContactSurface& surface_;
    const BroadPhase& broad_phase_;
    std::span<const Vec3> ends_;
    std::vector<Swept> swept_;
};

} // namespace weft
