#pragma once

#include "base/eigen.h"

#include <compare>
#include <span>
#include <vector>

namespace weft {

/// Symmetric matrix of 3x3 blocks in compressed rows; both triangles are stored, so that a product
/// runs over rows independently. Columns ascend within a row and every row has its diagonal block.
struct BlockMatrix {
    std::vector<Index> row_begin; ///< #rows + 1, into column and blocks
    std::vector<Index> column;
    std::vector<Index> diagonal; ///< #rows, place of the diagonal block
    std::vector<Mat3> blocks;

    std::size_t rows() const { return diagonal.size(); }
};

/// An entry of a symmetric pattern.
struct BlockEntry {
    Index row, column;
    auto operator<=>(const BlockEntry&) const = default;
};

/// A matrix with zero blocks at `entries` (any order, repeats allowed), at their transposes and on
/// the diagonal.
BlockMatrix make_pattern(std::size_t rows, std::span<const BlockEntry> entries);

/// Place of block (row, column) in matrix.blocks, or k_no_index.
Index find_block(const BlockMatrix& matrix, Index row, Index column);

/// Sum of a[i] . b[i], in an order that depends on the length alone.
double dot(std::span<const Vec3> a, std::span<const Vec3> b);

/// y = A x.
void multiply(const BlockMatrix& matrix, std::span<const Vec3> x, std::span<Vec3> y);

/// Order of the rows in which neighbours stand close together: breadth first from a far row,
/// reversed (Cuthill and McKee 1969). Returns new_of_old.
/// @param row_begin, column  of the pattern, as in BlockMatrix
std::vector<Index> locality_order(std::span<const Index> row_begin, std::span<const Index> column);

/// A matrix with the blocks of another one, its base, and blocks where contacts join rows. The
/// pattern is rebuilt only when contacts join other rows, beyond those that the base joins.
class CoupledMatrix {
public:
    /// Sets the pattern to the blocks of `base`, whose pattern must stay the same until `reset`,
    /// and `joined` (any order, repeats allowed). Returns whether the pattern changed.
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
    std::vector<Index> place_of_base_; ///< by block of the base
};

} // namespace weft
