#include "solver/coupled_matrix.h"

#include "base/parallel.h"

#include <algorithm>

namespace weft {

bool CoupledMatrix::couple(const BlockMatrix& base, std::span<const BlockEntry> joined) {
    wanted_.clear();
    for (const BlockEntry& entry : joined) {
        if (find_block(base, entry.row, entry.column) == k_no_index) {
            wanted_.push_back(entry);
            wanted_.push_back({entry.column, entry.row});
        }
    }
    std::sort(wanted_.begin(), wanted_.end());
    wanted_.erase(std::unique(wanted_.begin(), wanted_.end()), wanted_.end());
    if (is_built_ && wanted_ == extra_) {
        return false;
    }
    extra_.swap(wanted_);
    build(base);
    is_built_ = true;
    return true;
}

/// Merges the rows of the base with the extra blocks.
void CoupledMatrix::build(const BlockMatrix& base) {
    const std::size_t blocks = base.column.size() + extra_.size();
    matrix_.row_begin.clear();
    matrix_.column.clear();
    matrix_.diagonal.resize(base.rows());
    matrix_.blocks.resize(blocks);
    place_of_base_.resize(base.column.size());
    auto extra = extra_.begin();
    for (std::size_t r = 0; r < base.rows(); ++r) {
        matrix_.row_begin.push_back(static_cast<Index>(matrix_.column.size()));
        const auto row = static_cast<Index>(r);
        const auto take_extra_before = [&](Index column) {
            for (; extra != extra_.end() && extra->row == row && extra->column < column; ++extra) {
                matrix_.column.push_back(extra->column);
            }
        };
        for (Index k = base.row_begin[r]; k < base.row_begin[r + 1]; ++k) {
            const Index column = base.column[static_cast<std::size_t>(k)];
            take_extra_before(column);
            const auto place = static_cast<Index>(matrix_.column.size());
            place_of_base_[static_cast<std::size_t>(k)] = place;
            if (column == row) {
                matrix_.diagonal[r] = place;
            }
            matrix_.column.push_back(column);
        }
        take_extra_before(static_cast<Index>(base.rows()));
    }
    matrix_.row_begin.push_back(static_cast<Index>(matrix_.column.size()));
}

void CoupledMatrix::load(const BlockMatrix& base) {
    parallel_for(base.rows(), [&](std::size_t r) {
        for (Index k = matrix_.row_begin[r]; k < matrix_.row_begin[r + 1]; ++k) {
            matrix_.blocks[static_cast<std::size_t>(k)].setZero();
        }
        for (Index k = base.row_begin[r]; k < base.row_begin[r + 1]; ++k) {
            const auto place =
                static_cast<std::size_t>(place_of_base_[static_cast<std::size_t>(k)]);
            matrix_.blocks[place] = base.blocks[static_cast<std::size_t>(k)];
        }
    });
}

} // namespace weft
