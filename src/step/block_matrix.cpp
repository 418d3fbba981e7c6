#include "step/block_matrix.h"

#include "base/parallel.h"

#include <algorithm>
#include <cassert>

namespace weft {

namespace {

std::size_t degree(const BlockMatrix& pattern, Index row) {
    const auto r = static_cast<std::size_t>(row);
    return static_cast<std::size_t>(pattern.row_begin[r + 1] - pattern.row_begin[r]);
}

/// Rows reachable from `start`, level by level, within a level by degree; `seen` is marked.
std::vector<Index> breadth_first(const BlockMatrix& pattern, Index start, std::vector<char>& seen) {
    std::vector<Index> order{start};
    seen[static_cast<std::size_t>(start)] = 1;
    for (std::size_t head = 0; head < order.size(); ++head) {
        const auto row = static_cast<std::size_t>(order[head]);
        const std::size_t first_new = order.size();
        for (Index k = pattern.row_begin[row]; k < pattern.row_begin[row + 1]; ++k) {
            const Index next = pattern.column[static_cast<std::size_t>(k)];
            if (seen[static_cast<std::size_t>(next)] == 0) {
                seen[static_cast<std::size_t>(next)] = 1;
                order.push_back(next);
            }
        }
        std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(first_new), order.end(),
                         [&](Index a, Index b) { return degree(pattern, a) < degree(pattern, b); });
    }
    return order;
}

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

std::vector<Index> locality_order(const BlockMatrix& pattern) {
    const std::size_t rows = pattern.rows();
    std::vector<Index> old_of_new;
    std::vector<char> seen(rows, 0);
    for (std::size_t r = 0; r < rows; ++r) {
        if (seen[r] != 0) {
            continue;
        }
        std::vector<char> scratch = seen; // a first sweep only finds a row at the far end
        const Index far = breadth_first(pattern, static_cast<Index>(r), scratch).back();
        const std::vector<Index> part = breadth_first(pattern, far, seen);
        old_of_new.insert(old_of_new.end(), part.rbegin(), part.rend());
    }
    std::vector<Index> new_of_old(rows);
    for (std::size_t i = 0; i < rows; ++i) {
        new_of_old[static_cast<std::size_t>(old_of_new[i])] = static_cast<Index>(i);
    }
    return new_of_old;
}

} // namespace weft
