#pragma once

#include "forces/attachment_elements.h"
#include "solver/assembler.h"
#include "state/world.h"

#include <memory>

namespace weft {

/// All element forces of all deformables, and the matrix they make. Gravity and mass damping are
/// not here: they join no vertices. Vectors are by vertex of the world.
class ForceSystem {
public:
    ForceSystem(const World& world, const SceneParams& params);
    ~ForceSystem();

    /// Follows the cloths through a change of their meshes. The result is as if made of the world
    /// as it is now, but only what changed is rebuilt.
    /// @param changes  of each cloth, since the last call or the construction
    void remesh(const World& world, std::span<const ClothChanges> changes);

    const Assembler& assembler() const { return *assembler_; }

    /// Linearises at velocities v the forces that are linearised once a substep.
    void start_substep(std::span<const Vec3> v);

    /// Sets the attached pairs to the substep of this world that ends at `end_time` (s).
    void set_attachments(const World& world, double end_time);

    /// Forces (N) at positions x and velocities v, and the element blocks for `assemble`.
    void evaluate(std::span<const Vec3> x,
                  std::span<const Vec3> v,
                  SystemScales scales,
                  std::span<Vec3> forces);

    /// The same forces without the blocks.
    void forces_only(std::span<const Vec3> x, std::span<const Vec3> v, std::span<Vec3> forces);

    /// matrix = diagonal (kg, by vertex) + stiffness and damping, scaled as in the last `evaluate`.
    void assemble(std::span<const double> diagonal, BlockMatrix& matrix) const;

private:
    class Group;
    template <typename Elements, typename Owner> class GroupOf;

    std::vector<ElementSet> sets() const;
    void resize_arrays();

    std::vector<std::unique_ptr<Group>> groups_; ///< in the order in which they are summed
    AttachmentElements* attachments_;            ///< those of one of the groups
    std::unique_ptr<Assembler> assembler_;
    SystemScales scales_;
    std::vector<Vec3> element_forces_;
    std::vector<Mat3> element_blocks_;
};

} // namespace weft
