#pragma once

#include "base/eigen.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace weft {

/// Sets of the numbers 0..count-1, joined one by one. A set is named after its least number, so
/// that names do not depend on the order of the joins.
class DisjointSets {
public:
    DisjointSets() = default;
    explicit DisjointSets(std::size_t count) { reset(count); }

    /// Every number alone.
    void reset(std::size_t count) {
        parents_.resize(count);
        std::iota(parents_.begin(), parents_.end(), 0);
    }

    /// Name of the set of `i`.
    Index find(Index i) const {
        while (parent(i) != i) {
            i = parent(i);
        }
        return i;
    }

    void join(Index a, Index b) {
        a = shorten(a);
        b = shorten(b);
        parents_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }

private:
    Index parent(Index i) const { return parents_[static_cast<std::size_t>(i)]; }

    /// find(), which leaves shorter ways behind.
    Index shorten(Index i) {
        while (parent(i) != i) {
            i = parents_[static_cast<std::size_t>(i)] = parent(parent(i));
        }
        return i;
    }

    std::vector<Index> parents_;
};

} // namespace weft
