#pragma once

#include "solver/block_matrix.h"

namespace weft {

/// A matrix with the blocks of another one and those that contacts join. The pattern is made anew
/// only when what contacts join, beyond what the other one has, changes.
class CoupledMatrix {
public:
    /// Room for the blocks of `base`, whose pattern must be the same until `reset`, and for
    /// `joined` (any order, repeats allowed). True when the pattern changed.
    bool couple(const BlockMatrix& base, std::span<const BlockEntry> joined);

    /// Forgets the pattern.
    void reset() { is_built_ = false; }

    /// Sets the blocks of `base`, and zero elsewhere.
    void load(const BlockMatrix& base);

    BlockMatrix& matrix() { return matrix_; }

private:
    void build(const BlockMatrix& base);

    bool is_built_ = false;
    std::vector<BlockEntry> extra_, wanted_; ///< both triangles, sorted
    BlockMatrix matrix_;
    std::vector<Index> place_of_base_; ///< of each block of the base
};

} // namespace weft
