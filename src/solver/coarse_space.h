#pragma once

#include <Eigen/Cholesky>

#include "solver/block_matrix.h"

namespace weft {

/// The motions of a system that reach far: patches of neighbouring rows that move rigidly. What a
/// preconditioner that looks at neighbours alone needs many iterations to carry across the cloth is
/// solved here at once, in a small dense system A_c = P^T A P with six columns of P a patch: three
/// translations, and three rotations about the patch's centre.
///
/// Source: additive two-level Schwarz with a coarse space of rigid modes of aggregates (Vanek,
/// Mandel and Brezina 1996; Tamstorf, Jones and McCormick 2015 for cloth).
class CoarseSpace {
public:
    /// Cuts the rows of a pattern into patches of neighbours.
    void set_pattern(const BlockMatrix& pattern);

    /// The coarse system of a matrix with at least the rows of the pattern.
    /// @param places  #rows, where each row's vertex is, m
    /// @param fixed   #rows: 1: its row is the identity, it takes no part
    void
    build(const BlockMatrix& matrix, std::span<const Vec3> places, std::span<const char> fixed);

    /// z += P A_c^-1 P^T r.
    void add_correction(std::span<const Vec3> r, std::span<Vec3> z);

    /// Too few rows to gain anything, or a system that cannot be factored: corrections are zero.
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
