#pragma once

#include "geometry/box.h"

#include <bit>
#include <span>
#include <utility>
#include <vector>

namespace weft {

/// Binary tree of boxes over items 0..#boxes-1: built once by median splits, then refitted as the
/// items move. Nodes stand in depth-first order: the left child follows its parent.
class BoxTree {
public:
    /// Items a leaf holds at most. Smaller: more nodes to walk; larger: more pairs to test.
    static constexpr Index k_leaf_items = 4; // of FourBoxes

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
        Index right; ///< of an inner node: right child; of a leaf: -1 - first slot
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
    std::vector<Index> items_;          ///< in leaf order
    std::vector<Box> boxes_;            ///< of items_[slot]
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
