#include "solver/coarse_space.h"

#include "base/parallel.h"

#include <algorithm>

namespace weft {

namespace {

/// Rows a patch, and patches at most. Smaller patches: fewer iterations, each dearer by a larger
/// dense system. CPU time of a refined T-shirt and of a sheet over a sphere is within 10 % of the
/// same from 28 to 96 patches.
constexpr std::size_t k_patch_rows = 48;
constexpr std::size_t k_most_patches = 32;

/// Fewer rows than this are solved as fast without.
constexpr std::size_t k_least_rows = 256;

/// Keeps directions without inertia (a patch in a line cannot spin) from spoiling the factor.
constexpr double k_shift = 1e-8;

Mat3 cross_matrix(const Vec3& a) {
    Mat3 m;
    m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
    return m;
}

} // namespace

/// Breadth first from the lowest row that is left, until the patch is full; what is left over in
/// small pieces goes to a neighbour.
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
