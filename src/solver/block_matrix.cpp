#include "solver/block_matrix.h"

#include "base/parallel.h"

#include <algorithm>
#include <cassert>

namespace weft {

namespace {

/// Sweeps over the parts of a pattern, breadth first.
class Sweeps {
public:
    Sweeps(std::span<const Index> row_begin, std::span<const Index> column)
        : row_begin_(row_begin), column_(column), swept_(row_begin.size() - 1, 0) {}

    /// How often a row has been swept.
    int times(std::size_t row) const { return swept_[row]; }

    /// Writes the rows that can be reached from `start` and have been swept as often as it, level
    /// by level, within a level by degree. Returns how many.
    std::size_t sweep(Index start, Index* order) {
        const char before = swept_[static_cast<std::size_t>(start)]++;
        order[0] = start;
        std::size_t count = 1;
        for (std::size_t head = 0; head < count; ++head) {
            const auto row = static_cast<std::size_t>(order[head]);
            const std::size_t first_new = count;
            for (Index k = row_begin_[row]; k < row_begin_[row + 1]; ++k) {
                const Index next = column_[static_cast<std::size_t>(k)];
                if (swept_[static_cast<std::size_t>(next)] == before) {
                    ++swept_[static_cast<std::size_t>(next)];
                    order[count++] = next;
                }
            }
            sort_by_degree(order + first_new, order + count);
        }
        return count;
    }

private:
    Index degree(Index row) const {
        const auto r = static_cast<std::size_t>(row);
        return row_begin_[r + 1] - row_begin_[r];
    }

    /// Keeps the order of rows alike. By insertion: they are a few.
    void sort_by_degree(Index* begin, Index* end) const {
        for (Index* i = begin; i < end; ++i) {
            const Index row = *i;
            Index* gap = i;
            for (; gap > begin && degree(gap[-1]) > degree(row); --gap) {
                *gap = gap[-1];
            }
            *gap = row;
        }
    }

    std::span<const Index> row_begin_, column_;
    std::vector<char> swept_;
};

} // namespace

BlockMatrix make_pattern(std::size_t rows, std::span<const BlockEntry> entries) {
    std::vector<std::vector<Index>> columns(rows);
    for (std::size_t r = 0; r < rows; ++r) {
        columns[r].push_back(static_cast<Index>(r));
    }
    for (const BlockEntry& entry : entries) {
        columns[static_cast<std::size_t>(entry.row)].push_back(entry.column);
        columns[static_cast<std::size_t>(entry.column)].push_back(entry.row);
    }
    BlockMatrix matrix;
    matrix.row_begin.reserve(rows + 1);
    matrix.row_begin.push_back(0);
    for (std::size_t r = 0; r < rows; ++r) {
        auto& row = columns[r];
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        const auto diagonal = std::lower_bound(row.begin(), row.end(), static_cast<Index>(r));
        matrix.diagonal.push_back(matrix.row_begin.back() +
                                  static_cast<Index>(diagonal - row.begin()));
        matrix.column.insert(matrix.column.end(), row.begin(), row.end());
        matrix.row_begin.push_back(static_cast<Index>(matrix.column.size()));
    }
    matrix.blocks.assign(matrix.column.size(), Mat3::Zero());
    return matrix;
}

Index find_block(const BlockMatrix& matrix, Index row, Index column) {
    const auto r = static_cast<std::size_t>(row);
    const auto begin = matrix.column.begin() + matrix.row_begin[r];
    const auto end = matrix.column.begin() + matrix.row_begin[r + 1];
    const auto found = std::lower_bound(begin, end, column);
    return found != end && *found == column ? static_cast<Index>(found - matrix.column.begin())
                                            : k_no_index;
}

double dot(std::span<const Vec3> a, std::span<const Vec3> b) {
    return parallel_sum(a.size(), [&](std::size_t i) { return a[i].dot(b[i]); });
}

void multiply(const BlockMatrix& matrix, std::span<const Vec3> x, std::span<Vec3> y) {
    assert(x.size() == matrix.rows() && y.size() == matrix.rows());
    const Mat3* const blocks = matrix.blocks.data();
    const Index* const column = matrix.column.data();
    parallel_for(matrix.rows(), [&](std::size_t r) {
        double sum0 = 0.0;
        double sum1 = 0.0;
        double sum2 = 0.0;
        for (Index k = matrix.row_begin[r]; k < matrix.row_begin[r + 1]; ++k) {
            const double* const b = blocks[k].data(); // by columns
            const double* const v = x[static_cast<std::size_t>(column[k])].data();
            sum0 += b[0] * v[0] + b[3] * v[1] + b[6] * v[2];
            sum1 += b[1] * v[0] + b[4] * v[1] + b[7] * v[2];
            sum2 += b[2] * v[0] + b[5] * v[1] + b[8] * v[2];
        }
        y[r] = Vec3(sum0, sum1, sum2);
    });
}

std::vector<Index> locality_order(std::span<const Index> row_begin, std::span<const Index> column) {
    const std::size_t rows = row_begin.size() - 1;
    Sweeps sweeps(row_begin, column);
    std::vector<Index> old_of_new(rows);
    std::size_t done = 0;
    for (std::size_t r = 0; r < rows; ++r) {
        if (sweeps.times(r) != 0) {
            continue;
        }
        Index* const part = old_of_new.data() + done;
        // a first sweep only finds a row at the far end
        const std::size_t count = sweeps.sweep(static_cast<Index>(r), part);
        sweeps.sweep(part[count - 1], part);
        std::reverse(part, part + count);
        done += count;
    }
    std::vector<Index> new_of_old(rows);
    for (std::size_t i = 0; i < rows; ++i) {
        new_of_old[static_cast<std::size_t>(old_of_new[i])] = static_cast<Index>(i);
    }
    return new_of_old;
}

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
