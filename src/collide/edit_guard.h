#pragma once

#include "collide/broad_phase.h"
#include "state/refinement.h"

namespace weft {

/// Decides which local edits of a cloth's mesh are safe for contact. An edit moves the surface
/// through a tetrahedron, and is allowed when two things stay clear of this tetrahedron: all
/// triangles that do not touch its vertices, where they stood before the first edit; and the
/// tetrahedra of the edits allowed before.
///
/// Lives from the contact of one substep to the change of the mesh; the arguments of the
/// constructor must stay meanwhile.
class EditGuard {
public:
    /// @param ends  #V of the surface: where the last substep ended, m
    EditGuard(const ContactSurface& surface,
              const BroadPhase& broad_phase,
              std::span<const Vec3> ends)
        : surface_(surface), broad_phase_(broad_phase), ends_(ends) {}

    /// May a cloth's surface sweep this tetrahedron? If so, the edit counts as made.
    /// @param cloth     its number in World
    /// @param corners   m
    /// @param vertices  of the cloth; new ones have numbers past its first vertex count
    bool may_sweep(Index cloth,
                   const std::array<Vec3, 4>& corners,
                   const std::array<Index, 4>& vertices);

    /// Does a triangle that edits changed cross any other one? The exact test of all edits
    /// together, which may_sweep() has not made for neighbours.
    /// @param positions  #V of the cloth as it is now, m
    bool crosses(Index index,
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
