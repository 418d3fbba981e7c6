#include "solver/preconditioner.h"

#include "base/eigen.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

/// Rows a domain. Smaller: more domains to spread over threads, but weaker coupling and more
/// iterations; 1024 costs about 5 % more iterations than one domain on a 64 x 64 sheet.
constexpr std::size_t k_domain_rows = 1024;
constexpr float k_first_shift = 1e-3F;
constexpr float k_greatest_shift = 1e4F;

/// Inverse of the lower Cholesky factor of a symmetric 3x3 matrix; false when it is not positive.
bool invert_cholesky(const Eigen::Matrix3f& a, Eigen::Matrix3f& inverse) {
    const float d0 = a(0, 0);
    if (!(d0 > 0.0F)) {
        return false;
    }
    const float l00 = std::sqrt(d0);
    const float l10 = a(1, 0) / l00;
    const float l20 = a(2, 0) / l00;
    const float d1 = a(1, 1) - l10 * l10;
    if (!(d1 > 1e-6F * a(1, 1))) {
        return false;
    }
    const float l11 = std::sqrt(d1);
    const float l21 = (a(2, 1) - l20 * l10) / l11;
    const float d2 = a(2, 2) - l20 * l20 - l21 * l21;
    if (!(d2 > 1e-6F * a(2, 2))) {
        return false;
    }
    const float l22 = std::sqrt(d2);
    const float i00 = 1.0F / l00;
    const float i11 = 1.0F / l11;
    const float i22 = 1.0F / l22;
    const float i10 = -l10 * i00 * i11;
    const float i21 = -l21 * i11 * i22;
    const float i20 = -(l20 * i00 + l21 * i10) * i22;
    inverse << i00, 0.0F, 0.0F, i10, i11, 0.0F, i20, i21, i22;
    return std::isfinite(i00 + i11 + i22);
}

/// Rows a patch, and patches at most. Smaller patches: fewer iterations, each dearer by a larger
/// dense system. CPU time of a refined T-shirt and of a sheet over a sphere is within 10 % of the
/// same from 28 to 96 patches.
constexpr std::size_t k_patch_rows = 48;
constexpr std::size_t k_most_patches = 32;

/// Fewer rows than this are solved as fast without.
constexpr std::size_t k_least_rows = 256;

/// Keeps directions without inertia (a patch in a line cannot spin) from spoiling the factor.
constexpr double k_shift = 1e-8;

} // namespace

void IncompleteCholesky::build_structure(const BlockMatrix& matrix) {
    const std::size_t rows = matrix.rows();
    const std::size_t count = std::max<std::size_t>(1, rows / k_domain_rows);
    domains_.clear();
    for (std::size_t d = 0; d < count; ++d) {
        domains_.push_back(
            {static_cast<Index>(d * rows / count), static_cast<Index>((d + 1) * rows / count)});
    }
    row_begin_.assign(1, 0);
    column_.clear();
    source_.clear();
    for (const Domain& domain : domains_) {
        for (Index r = domain.begin; r < domain.end; ++r) {
            const auto row = static_cast<std::size_t>(r);
            for (Index k = matrix.row_begin[row]; k < matrix.diagonal[row]; ++k) {
                const Index c = matrix.column[static_cast<std::size_t>(k)];
                if (c >= domain.begin) {
                    column_.push_back(c);
                    source_.push_back(k);
                }
            }
            row_begin_.push_back(static_cast<Index>(column_.size()));
        }
    }
    lower_.resize(column_.size());
    inverse_diagonal_.resize(rows);
    work_.resize(rows);
}

void IncompleteCholesky::factor(const BlockMatrix& matrix) {
    if (inverse_diagonal_.size() != matrix.rows()) {
        build_structure(matrix);
    }
    std::vector<float> shifts(domains_.size(), 0.0F);
    parallel_for(
        domains_.size(),
        [&](std::size_t d) {
            while (!factor_domain(matrix, domains_[d], shifts[d]) && shifts[d] < k_greatest_shift) {
                shifts[d] = std::max(k_first_shift, 4.0F * shifts[d]);
            }
        },
        1);
    shift_ = *std::max_element(shifts.begin(), shifts.end());
}

bool IncompleteCholesky::factor_domain(const BlockMatrix& matrix,
                                       const Domain& domain,
                                       float shift) {
    for (Index r = domain.begin; r < domain.end; ++r) {
        if (!factor_row(matrix, r, shift)) {
            return false;
        }
    }
    return true;
}

bool IncompleteCholesky::factor_row(const BlockMatrix& matrix, Index row, float shift) {
    const auto i = static_cast<std::size_t>(row);
    const Index begin = row_begin_[i];
    const Index end = row_begin_[i + 1];
    Block diagonal = matrix.blocks[static_cast<std::size_t>(matrix.diagonal[i])].cast<float>();
    diagonal.diagonal() *= 1.0F + shift;
    for (Index p = begin; p < end; ++p) {
        const auto k = static_cast<std::size_t>(column_[static_cast<std::size_t>(p)]);
        const auto source = static_cast<std::size_t>(source_[static_cast<std::size_t>(p)]);
        Block sum = matrix.blocks[source].cast<float>();
        Index a = begin; // merge row i with row k over their common columns before k
        Index b = row_begin_[k];
        while (a < p && b < row_begin_[k + 1]) {
            const Index ca = column_[static_cast<std::size_t>(a)];
            const Index cb = column_[static_cast<std::size_t>(b)];
            if (ca == cb) {
                sum.noalias() -= lower_[static_cast<std::size_t>(a)] *
                                 lower_[static_cast<std::size_t>(b)].transpose();
            }
            a += ca <= cb ? 1 : 0;
            b += cb <= ca ? 1 : 0;
        }
        Block& entry = lower_[static_cast<std::size_t>(p)];
        entry.noalias() = sum * inverse_diagonal_[k].transpose();
        diagonal.noalias() -= entry * entry.transpose();
    }
    return invert_cholesky(diagonal, inverse_diagonal_[i]);
}

void IncompleteCholesky::solve_domain(const Domain& domain,
                                      std::span<const Vec3> r,
                                      std::span<Vec3> z) {
    // Forward L y = r by rows, then backward L^T z = y by columns of L^T.
    Vec3f* const work = work_.data();
    for (Index row = domain.begin; row < domain.end; ++row) {
        const auto i = static_cast<std::size_t>(row);
        Vec3f sum = r[i].cast<float>();
        for (Index p = row_begin_[i]; p < row_begin_[i + 1]; ++p) {
            sum.noalias() -=
                lower_[static_cast<std::size_t>(p)] * work[column_[static_cast<std::size_t>(p)]];
        }
        work[i].noalias() = inverse_diagonal_[i] * sum;
    }
    for (Index row = domain.end; row-- > domain.begin;) {
        const auto i = static_cast<std::size_t>(row);
        const Vec3f x = inverse_diagonal_[i].transpose() * work[i];
        for (Index p = row_begin_[i]; p < row_begin_[i + 1]; ++p) {
            work[column_[static_cast<std::size_t>(p)]].noalias() -=
                lower_[static_cast<std::size_t>(p)].transpose() * x;
        }
        z[i] = x.cast<double>();
    }
}

void IncompleteCholesky::apply(std::span<const Vec3> r, std::span<Vec3> z) {
    parallel_for(
        domains_.size(), [&](std::size_t d) { solve_domain(domains_[d], r, z); }, 1);
}

/// Grows each patch breadth first from the lowest row that is left, until it is full. A small
/// leftover joins a neighbouring patch.
void CoarseSpace::set_pattern(const BlockMatrix& pattern) {
    const std::size_t rows = pattern.rows();
    is_factored_ = false;
    patch_of_row_.assign(rows, k_no_index);
    patch_begin_.clear();
    if (rows < k_least_rows) {
        return;
    }
    const std::size_t full = std::max(k_patch_rows, rows / k_most_patches);
    Index count = 0;
    std::vector<Index> queue;
    for (std::size_t seed = 0; seed < rows; ++seed) {
        if (patch_of_row_[seed] != k_no_index) {
            continue;
        }
        queue.assign(1, static_cast<Index>(seed));
        patch_of_row_[seed] = count;
        Index beside = k_no_index; // a patch that is there already
        for (std::size_t head = 0; head < queue.size(); ++head) {
            const std::size_t row = at(queue[head]);
            for (Index k = pattern.row_begin[row]; k < pattern.row_begin[row + 1]; ++k) {
                Index& patch = patch_of_row_[at(pattern.column[at(k)])];
                if (patch == k_no_index && queue.size() < full) {
                    patch = count;
                    queue.push_back(pattern.column[at(k)]);
                } else if (patch != k_no_index && patch != count && beside == k_no_index) {
                    beside = patch;
                }
            }
        }
        if (queue.size() < full / 3 && beside != k_no_index) {
            for (const Index row : queue) {
                patch_of_row_[at(row)] = beside;
            }
        } else {
            ++count;
        }
    }
    patch_begin_.assign(at(count) + 1, 0);
    for (const Index patch : patch_of_row_) {
        ++patch_begin_[at(patch) + 1];
    }
    for (std::size_t p = 0; p < at(count); ++p) {
        patch_begin_[p + 1] += patch_begin_[p];
    }
    patch_rows_.resize(rows);
    std::vector<Index> next(patch_begin_.begin(), patch_begin_.end() - 1);
    for (std::size_t r = 0; r < rows; ++r) {
        patch_rows_[at(next[at(patch_of_row_[r])]++)] = static_cast<Index>(r);
    }
}

void CoarseSpace::build(const BlockMatrix& matrix,
                        std::span<const Vec3> places,
                        std::span<const char> fixed) {
    is_factored_ = false;
    const std::size_t patches = patch_count();
    if (patches == 0) {
        return;
    }
    fixed_.assign(fixed.begin(), fixed.end());
    arms_.resize(places.size());
    const auto size = static_cast<Eigen::Index>(6 * patches);
    system_.setZero(size, size);
    parallel_for(
        patches,
        [&](std::size_t p) {
            const auto rows =
                std::span(patch_rows_)
                    .subspan(at(patch_begin_[p]), at(patch_begin_[p + 1] - patch_begin_[p]));
            Vec3 centre = Vec3::Zero();
            for (const Index row : rows) {
                centre += places[at(row)] / static_cast<double>(rows.size());
            }
            double radius = 0.0;
            for (const Index row : rows) {
                arms_[at(row)] = places[at(row)] - centre;
                radius = std::max(radius, arms_[at(row)].norm());
            }
            for (const Index row : rows) {
                arms_[at(row)] /= radius > 0.0 ? radius : 1.0;
            }
        },
        1);
    parallel_for(
        patches, [&](std::size_t p) { assemble_patch(matrix, p); }, 1);
    const double shift = k_shift * system_.diagonal().mean();
    system_.diagonal().array() += shift > 0.0 ? shift : 1.0;
    factor_.compute(system_);
    is_factored_ = factor_.info() == Eigen::Success;
}

/// The six rows of a patch: P_i = [1, -[arm_i]x], so that P^T A P sums over the blocks of its rows.
void CoarseSpace::assemble_patch(const BlockMatrix& matrix, std::size_t patch) {
    const auto first = static_cast<Eigen::Index>(6 * patch);
    for (Index s = patch_begin_[patch]; s < patch_begin_[patch + 1]; ++s) {
        const std::size_t i = at(patch_rows_[at(s)]);
        if (fixed_[i] != 0) {
            continue;
        }
        const Mat3 turn_i = cross_matrix(arms_[i]); // (-[arm]x)^T
        for (Index k = matrix.row_begin[i]; k < matrix.row_begin[i + 1]; ++k) {
            const std::size_t j = at(matrix.column[at(k)]);
            if (fixed_[j] != 0) {
                continue;
            }
            const Mat3& a = matrix.blocks[at(k)];
            const Mat3 a_turn = -a * cross_matrix(arms_[j]);
            const auto column = static_cast<Eigen::Index>(6 * at(patch_of_row_[j]));
            system_.block<3, 3>(first, column) += a;
            system_.block<3, 3>(first, column + 3) += a_turn;
            system_.block<3, 3>(first + 3, column) += turn_i * a;
            system_.block<3, 3>(first + 3, column + 3) += turn_i * a_turn;
        }
    }
}

void CoarseSpace::add_correction(std::span<const Vec3> r, std::span<Vec3> z) {
    if (!is_factored_) {
        return;
    }
    values_.resize(system_.rows());
    parallel_for(
        patch_count(),
        [&](std::size_t p) {
            Vec3 push = Vec3::Zero();
            Vec3 turn = Vec3::Zero();
            for (Index s = patch_begin_[p]; s < patch_begin_[p + 1]; ++s) {
                const std::size_t i = at(patch_rows_[at(s)]);
                if (fixed_[i] == 0) {
                    push += r[i];
                    turn += arms_[i].cross(r[i]);
                }
            }
            values_.segment<3>(static_cast<Eigen::Index>(6 * p)) = push;
            values_.segment<3>(static_cast<Eigen::Index>(6 * p + 3)) = turn;
        },
        16);
    factor_.solveInPlace(values_);
    parallel_for(r.size(), [&](std::size_t i) {
        if (fixed_[i] == 0) {
            const auto first = static_cast<Eigen::Index>(6 * at(patch_of_row_[i]));
            z[i] += values_.segment<3>(first) - arms_[i].cross(values_.segment<3>(first + 3));
        }
    });
}

} // namespace weft
