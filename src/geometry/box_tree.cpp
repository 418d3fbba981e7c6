#include "geometry/box_tree.h"

#include "base/parallel.h"

#include <cassert>
#include <numeric>

namespace weft {

namespace {

Vec3 centre(const Box& box) {
    Vec3 c;
    for (std::size_t k = 0; k < 3; ++k) {
        c[static_cast<Eigen::Index>(k)] =
            0.5 * (static_cast<double>(box.low[k]) + static_cast<double>(box.high[k]));
    }
    return c;
}

} // namespace

BoxTree::BoxTree(std::span<const Box> boxes) {
    if (boxes.empty()) {
        return;
    }
    std::vector<Vec3> centres(boxes.size());
    std::transform(boxes.begin(), boxes.end(), centres.begin(), centre);
    items_.resize(boxes.size());
    std::iota(items_.begin(), items_.end(), 0);
    boxes_.resize(boxes.size());
    leaf_boxes_.resize((boxes.size() + k_leaf_items - 1) / k_leaf_items);
    nodes_.reserve(boxes.size());
    std::vector<Key> keys;
    keys.reserve(boxes.size());
    build(centres, 0, static_cast<Index>(boxes.size()), keys);
    refit(boxes);
}

/// @param keys room for what is compared of the items, side by side
Index BoxTree::build(std::span<const Vec3> centres,
                     Index begin,
                     Index end,
                     std::vector<Key>& keys) {
    const auto self = static_cast<Index>(nodes_.size());
    if (end - begin <= k_leaf_items) {
        nodes_.push_back({Box{}, -1 - begin, end - begin});
        return self;
    }
    Vec3 low = centres[at(items_[at(begin)])];
    Vec3 high = low;
    for (Index i = begin; i < end; ++i) {
        low = low.cwiseMin(centres[at(items_[at(i)])]);
        high = high.cwiseMax(centres[at(items_[at(i)])]);
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    // Whole leaves on the left, so that the tree is as small as it can be.
    const Index leaves = (end - begin + k_leaf_items - 1) / k_leaf_items;
    const Index middle = begin + (leaves + 1) / 2 * k_leaf_items;
    keys.clear();
    for (Index i = begin; i < end; ++i) {
        keys.push_back({centres[at(items_[at(i)])][axis], items_[at(i)]});
    }
    std::nth_element(keys.begin(), keys.begin() + (middle - begin), keys.end());
    for (Index i = begin; i < end; ++i) {
        items_[at(i)] = keys[at(i - begin)].item;
    }
    nodes_.push_back({Box{}, 0, 0});
    build(centres, begin, middle, keys);
    const Index right = build(centres, middle, end, keys);
    nodes_[at(self)].right = right;
    return self;
}

void BoxTree::refit(std::span<const Box> boxes) {
    assert(boxes.size() == items_.size());
    fit_leaves(boxes);
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        Node& n = nodes_[i];
        if (!n.is_leaf()) {
            n.box = unite(nodes_[i + 1].box, nodes_[at(n.right)].box);
        }
    }
}

void BoxTree::fit_leaves(std::span<const Box> boxes) {
    parallel_for(nodes_.size(), [&](std::size_t i) {
        Node& n = nodes_[i];
        if (!n.is_leaf()) {
            return;
        }
        n.box = Box{};
        for (Index slot = n.first(); slot < n.first() + n.count; ++slot) {
            boxes_[at(slot)] = boxes[at(items_[at(slot)])];
            leaf_boxes_[at(slot / k_leaf_items)].set(at(slot % k_leaf_items), boxes_[at(slot)]);
            n.box = unite(n.box, boxes_[at(slot)]);
        }
    });
}

double BoxTree::size_of(Index i) const {
    const Box& box = node(i).box;
    return static_cast<double>(box.high[0] - box.low[0]) +
           static_cast<double>(box.high[1] - box.low[1]) +
           static_cast<double>(box.high[2] - box.low[2]);
}

void BoxTree::split(const BoxTree& a,
                    const BoxTree& b,
                    std::size_t count,
                    std::vector<Task>& tasks) {
    tasks.clear();
    if (a.empty() || b.empty()) {
        return;
    }
    tasks.emplace_back(0, 0);
    std::vector<Task> next;
    bool grown = true;
    while (grown && tasks.size() < count) {
        grown = false;
        next.clear();
        for (const Task& task : tasks) {
            const Node& left = a.node(task.first);
            const Node& right = b.node(task.second);
            if (!overlap(left.box, right.box)) {
                continue;
            }
            if (left.is_leaf() && right.is_leaf()) {
                next.push_back(task);
                continue;
            }
            expand(a, b, task, [&](Task child) { next.push_back(child); });
            grown = true;
        }
        tasks.swap(next);
    }
}

} // namespace weft
