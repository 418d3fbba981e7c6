#pragma once

#include "solver/block_matrix.h"

namespace weft {

/// Incomplete block Cholesky factor without fill, A ~ L L^T, in single precision: it only steers
/// the iteration, and half the memory makes it twice as fast. Rows are cut into fixed domains that
/// ignore each other (additive Schwarz without overlap), so that domains run in parallel with the
/// same bits.
///
/// A pivot that is not positive restarts with the diagonal scaled up (Manteuffel 1980).
class IncompleteCholesky {
public:
    /// Numeric factor of `matrix`, whose pattern must stay that of the first call until `reset`.
    void factor(const BlockMatrix& matrix);

    /// Forgets the pattern.
    void reset() { inverse_diagonal_.clear(); }

    /// z = (L L^T)^-1 r.
    void apply(std::span<const Vec3> r, std::span<Vec3> z);

    double shift() const { return shift_; } ///< of the diagonal in the last factor, relative

private:
    using Block = Eigen::Matrix3f;
    struct Domain {
        Index begin, end; ///< rows
    };

    void build_structure(const BlockMatrix& matrix);
    bool factor_domain(const BlockMatrix& matrix, const Domain& domain, float shift);
    bool factor_row(const BlockMatrix& matrix, Index row, float shift);
    void solve_domain(const Domain& domain, std::span<const Vec3> r, std::span<Vec3> z);

    std::vector<Domain> domains_;
    std::vector<Index> row_begin_; ///< of the strictly lower blocks inside a domain
    std::vector<Index> column_;
    std::vector<Index> source_; ///< place of each in matrix.blocks
    std::vector<Block> lower_;
    std::vector<Block> inverse_diagonal_; ///< inverse of the lower triangular L_ii
    std::vector<Vec3f> work_;             ///< #rows
    double shift_ = 0.0;
};

} // namespace weft
