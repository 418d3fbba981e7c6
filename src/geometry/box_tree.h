#pragma once

#include "base/eigen.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace weft {

/// Axis-aligned box in single precision; the conversion from double rounds outwards, so a box never
/// misses what it was made of. Starts empty.
struct Box {
    std::array<float, 3> low = {k_empty, k_empty, k_empty};
    std::array<float, 3> high = {-k_empty, -k_empty, -k_empty};

    static constexpr float k_empty = std::numeric_limits<float>::infinity();
};

/// The largest float not above x, or the one below it; of lowest magnitudes 1e-38.
inline float float_below(double x) {
    const auto f = static_cast<float>(x);
    return f - (std::abs(f) * 1.2e-7F + 1e-37F);
}

/// The smallest float not below x, or the one above it.
inline float float_above(double x) {
    const auto f = static_cast<float>(x);
    return f + (std::abs(f) * 1.2e-7F + 1e-37F);
}

/// Box of the segment from a to b, larger by `margin` (m) on all sides.
inline Box segment_box(const Vec3& a, const Vec3& b, double margin) {
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        box.low[k] = float_below(std::min(a[i], b[i]) - margin);
        box.high[k] = float_above(std::max(a[i], b[i]) + margin);
    }
    return box;
}

inline Box unite(const Box& a, const Box& b) {
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min(a.low[k], b.low[k]);
        box.high[k] = std::max(a.high[k], b.high[k]);
    }
    return box;
}

/// True when the closed boxes share a point. One branch instead of six: which of them it would be
/// could not be foreseen.
inline bool overlap(const Box& a, const Box& b) {
#if defined(__SSE2__)
    static_assert(sizeof(Box) == 6 * sizeof(float));
    const auto load = [](const Box& box, std::size_t first) {
        __m128 four;
        std::memcpy(&four, reinterpret_cast<const char*>(&box) + first * sizeof(float),
                    sizeof four);
        return four;
    };
    const auto low = [&](const Box& box) { return load(box, 0); }; // and one more
    const auto high = [&](const Box& box) {
        const __m128 last = load(box, 2); // one before them
        return _mm_shuffle_ps(last, last, _MM_SHUFFLE(3, 3, 2, 1));
    };
    const __m128 meets = _mm_and_ps(_mm_cmple_ps(low(a), high(b)), _mm_cmple_ps(low(b), high(a)));
    return (_mm_movemask_ps(meets) & 7) == 7;
#else
    return static_cast<bool>(int(a.low[0] <= b.high[0]) & int(b.low[0] <= a.high[0]) &
                             int(a.low[1] <= b.high[1]) & int(b.low[1] <= a.high[1]) &
                             int(a.low[2] <= b.high[2]) & int(b.low[2] <= a.high[2]));
#endif
}

/// Four boxes side by side; those not set are empty.
struct FourBoxes {
    std::array<std::array<float, 4>, 3> low, high; ///< [axis][box]

    FourBoxes() {
        low.fill({Box::k_empty, Box::k_empty, Box::k_empty, Box::k_empty});
        high.fill({-Box::k_empty, -Box::k_empty, -Box::k_empty, -Box::k_empty});
    }
    void set(std::size_t i, const Box& box) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k][i] = box.low[k];
            high[k][i] = box.high[k];
        }
    }
};

/// Bit i is set when box i of four overlaps this one.
inline unsigned overlaps_of(const FourBoxes& four, const Box& box) {
#if defined(__SSE2__)
    __m128 meets = _mm_castsi128_ps(_mm_set1_epi32(-1));
    for (std::size_t k = 0; k < 3; ++k) {
        const __m128 low = _mm_loadu_ps(four.low[k].data());
        const __m128 high = _mm_loadu_ps(four.high[k].data());
        meets = _mm_and_ps(meets, _mm_and_ps(_mm_cmple_ps(low, _mm_set1_ps(box.high[k])),
                                             _mm_cmple_ps(_mm_set1_ps(box.low[k]), high)));
    }
    return static_cast<unsigned>(_mm_movemask_ps(meets));
#else
    unsigned meets = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        bool all = true;
        for (std::size_t k = 0; k < 3; ++k) {
            all = all && four.low[k][i] <= box.high[k] && box.low[k] <= four.high[k][i];
        }
        meets |= (all ? 1U : 0U) << i;
    }
    return meets;
#endif
}

/// Square of the distance (m^2) from a point to a box; 0 inside.
inline double distance_squared(const Box& box, const Vec3& p) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double x = p[static_cast<Eigen::Index>(k)];
        const double outside = std::max(
            {0.0, static_cast<double>(box.low[k]) - x, x - static_cast<double>(box.high[k])});
        sum += outside * outside;
    }
    return sum;
}

/// Binary tree of boxes over items 0..#boxes-1: built once by median splits, then refitted as the
/// items move. Nodes stand in depth-first order: the left child follows its parent.
class BoxTree {
public:
    /// Items a leaf holds at most. Smaller: more nodes to walk; larger: more pairs to test.
    static constexpr Index k_leaf_items = 4; // one FourBoxes

    BoxTree() = default;

    /// Splits at the median of the box centres along the longest side of their bounds.
    explicit BoxTree(std::span<const Box> boxes);

    /// Takes new boxes for the same items; the splits stay.
    void refit(std::span<const Box> boxes);

    bool empty() const { return nodes_.empty(); }
    const Box& bounds() const { return nodes_.front().box; }

    /// Calls f(item) for each item whose box meets `box`.
    template <typename F> void query(const Box& box, const F& f) const;

    /// Calls f(item) for each item whose box is nearer to `p` than the square root of `limit`
    /// (m^2); f may lower `limit`, so that what is further away is passed over. The side of p comes
    /// first.
    template <typename F> void near(const Vec3& p, double& limit, const F& f) const;

    /// A pair of nodes whose items are still to be compared.
    using Task = std::pair<Index, Index>;

    /// Cuts the comparison of two trees (or of one with itself: a == b) into about `count` tasks
    /// whose number and order depend on the boxes alone.
    static void
    split(const BoxTree& a, const BoxTree& b, std::size_t count, std::vector<Task>& tasks);

    /// Calls f(item of a, item of b) for each pair with overlapping boxes under a task; with
    /// a == b each unordered pair of different items once.
    template <typename F>
    static void overlaps(const BoxTree& a, const BoxTree& b, Task task, const F& f);

private:
    struct Node {
        Box box;
        Index right; ///< inner node: right child; leaf: -1 - first slot
        Index count; ///< items of a leaf; 0 = inner node

        bool is_leaf() const { return count > 0; }
        Index first() const { return -1 - right; }
    };

    /// Where an item's centre stands along the axis that is split; of two alike the first item.
    struct Key {
        double place;
        Index item;
        bool operator<(const Key& other) const {
            return place != other.place ? place < other.place : item < other.item;
        }
    };

    const Node& node(Index i) const { return nodes_[at(i)]; }
    const FourBoxes& boxes_of(const Node& leaf) const {
        return leaf_boxes_[at(leaf.first() / k_leaf_items)];
    }
    double size_of(Index i) const;
    Index build(std::span<const Vec3> centres, Index begin, Index end, std::vector<Key>& keys);
    void fit_leaves(std::span<const Box> boxes);

    template <typename F>
    static void leaf_overlaps(
        const BoxTree& a, const BoxTree& b, const Node& left, const Node& right, const F& f);
    template <typename G>
    static void expand(const BoxTree& a, const BoxTree& b, Task task, const G& push);

    std::vector<Node> nodes_;
    std::vector<Index> items_;          ///< sorted by leaf
    std::vector<Box> boxes_;            ///< [slot]: box of items_[slot]
    std::vector<FourBoxes> leaf_boxes_; ///< the same, by first slot / k_leaf_items
};

template <typename F> void BoxTree::query(const Box& box, const F& f) const {
    if (empty()) {
        return;
    }
    std::array<Index, 64> stack; // depth: log2(items) + 1, at most 32
    std::size_t top = 0;
    stack[top++] = 0;
    while (top > 0) {
        const Index i = stack[--top];
        const Node& n = node(i);
        if (!overlap(n.box, box)) {
            continue;
        }
        if (!n.is_leaf()) {
            stack[top++] = n.right;
            stack[top++] = i + 1;
            continue;
        }
        for (unsigned meets = overlaps_of(boxes_of(n), box); meets != 0; meets &= meets - 1) {
            f(items_[at(n.first() + std::countr_zero(meets))]);
        }
    }
}

template <typename F> void BoxTree::near(const Vec3& p, double& limit, const F& f) const {
    if (empty()) {
        return;
    }
    std::array<Index, 64> stack;
    std::size_t top = 0;
    stack[top++] = 0;
    while (top > 0) {
        const Index i = stack[--top];
        const Node& n = node(i);
        if (distance_squared(n.box, p) >= limit) {
            continue;
        }
        if (n.is_leaf()) {
            for (Index slot = n.first(); slot < n.first() + n.count; ++slot) {
                if (distance_squared(boxes_[at(slot)], p) < limit) {
                    f(items_[at(slot)]);
                }
            }
            continue;
        }
        const bool left_is_nearer =
            distance_squared(node(i + 1).box, p) <= distance_squared(node(n.right).box, p);
        stack[top++] = left_is_nearer ? n.right : i + 1;
        stack[top++] = left_is_nearer ? i + 1 : n.right;
    }
}

template <typename F>
void BoxTree::leaf_overlaps(
    const BoxTree& a, const BoxTree& b, const Node& left, const Node& right, const F& f) {
    const bool same = &left == &right;
    for (Index i = left.first(); i < left.first() + left.count; ++i) {
        unsigned meets = overlaps_of(b.boxes_of(right), a.boxes_[at(i)]);
        if (same) {
            meets &= ~0U << (i - left.first() + 1); // those after it
        }
        for (; meets != 0; meets &= meets - 1) {
            f(a.items_[at(i)], b.items_[at(right.first() + std::countr_zero(meets))]);
        }
    }
}

template <typename G>
void BoxTree::expand(const BoxTree& a, const BoxTree& b, Task task, const G& push) {
    const Node& left = a.node(task.first);
    const Node& right = b.node(task.second);
    if (&a == &b && task.first == task.second) {
        push(Task{task.first + 1, task.first + 1});
        push(Task{task.first + 1, left.right});
        push(Task{left.right, left.right});
    } else if (right.is_leaf() ||
               (!left.is_leaf() && a.size_of(task.first) >= b.size_of(task.second))) {
        push(Task{task.first + 1, task.second});
        push(Task{left.right, task.second});
    } else {
        push(Task{task.first, task.second + 1});
        push(Task{task.first, right.right});
    }
}

template <typename F>
void BoxTree::overlaps(const BoxTree& a, const BoxTree& b, Task task, const F& f) {
    std::array<Task, 160> stack; // each level of either tree leaves at most two behind
    std::size_t top = 0;
    stack[top++] = task;
    while (top > 0) {
        const Task now = stack[--top];
        const Node& left = a.node(now.first);
        const Node& right = b.node(now.second);
        if (!overlap(left.box, right.box)) {
            continue;
        }
        if (left.is_leaf() && right.is_leaf()) {
            leaf_overlaps(a, b, left, right, f);
        } else {
            expand(a, b, now, [&](Task next) { stack[top++] = next; });
        }
    }
}

} // namespace weft
