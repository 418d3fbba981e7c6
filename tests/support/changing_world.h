#pragma once

#include "state/world.h"
#include "support/changing_sheet.h"

namespace weft::test {

/// Some sheets whose meshes change at random, with threads between vertices taken at random. Where
/// a vertex is, how it moves and what it weighs follow from its place on its sheet.
class ChangingWorld {
public:
    /// @param sheet_count  alternately with mid-edge and quadratic bending
    ChangingWorld(int sheet_count, unsigned seed);

    const World& world() const { return world_; }
    World& world() { return world_; }

    /// See ChangingSheet; sheet i tries `edits[i]` edits. Returns what changed of each cloth.
    std::vector<ClothChanges> change(std::span<const int> edits, double growth);

private:
    void rebuild_world();

    std::mt19937 random_;
    std::vector<ChangingSheet> sheets_;
    World world_;
};

} // namespace weft::test
