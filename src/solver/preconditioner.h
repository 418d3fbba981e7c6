#pragma once

#include "solver/block_matrix.h"

#include <Eigen/Cholesky>

/// The preconditioner of the conjugate gradients has two levels: a local factor, and a coarse space
/// that carries what must reach far.
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

    double shift() const { return shift_; } ///< relative shift of the diagonal in the last factor

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
    std::vector<Index> row_begin_; ///< strictly lower blocks inside a domain
    std::vector<Index> column_;
    std::vector<Index> source_; ///< place of each in matrix.blocks
    std::vector<Block> lower_;
    std::vector<Block> inverse_diagonal_; ///< inverse of the lower triangular L_ii
    std::vector<Vec3f> work_;             ///< #rows
    double shift_ = 0.0;
};

/// The coarse level: patches of neighbouring rows that move rigidly. A local preconditioner needs
/// many iterations to carry a motion across the cloth; the coarse space solves for it at once, in a
/// small dense system A_c = P^T A P with six columns of P a patch: three translations, and three
/// rotations about the patch's centre.
///
/// Source: additive two-level Schwarz with a coarse space of rigid modes of aggregates (Vanek,
/// Mandel and Brezina 1996; Tamstorf, Jones and McCormick 2015 for cloth).
class CoarseSpace {
public:
    /// Cuts the rows of a pattern into patches of neighbours.
    void set_pattern(const BlockMatrix& pattern);

    /// The coarse system of a matrix with at least the rows of the pattern.
    /// @param places  #rows, where each row's vertex is, m
    /// @param fixed   #rows; 1: the row is the identity and takes no part
    void
    build(const BlockMatrix& matrix, std::span<const Vec3> places, std::span<const char> fixed);

    /// z += P A_c^-1 P^T r.
    void add_correction(std::span<const Vec3> r, std::span<Vec3> z);

    /// True with too few rows to gain anything, or when the system could not be factored:
    /// corrections are then zero.
    bool is_empty() const { return !is_factored_; }

    std::size_t patch_count() const { return patch_begin_.empty() ? 0 : patch_begin_.size() - 1; }
    std::span<const Index> patch_of_row() const { return patch_of_row_; }

private:
    void assemble_patch(const BlockMatrix& matrix, std::size_t patch);

    std::vector<Index> patch_of_row_;
    std::vector<Index> patch_begin_, patch_rows_; ///< rows of each patch, ascending
    std::vector<Vec3> arms_;                      ///< #rows, from the patch's centre, in its size
    std::vector<char> fixed_;
    Eigen::MatrixXd system_;
    Eigen::LLT<Eigen::MatrixXd> factor_;
    Eigen::VectorXd values_;
    bool is_factored_ = false;
};

} // namespace weft
