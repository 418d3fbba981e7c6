#include "base/parallel.h"
#include "geometry/box_tree.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace weft {

namespace {

using Pairs = std::set<std::pair<Index, Index>>;

std::vector<Box> random_boxes(std::size_t count, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 a(unit(engine), unit(engine), unit(engine));
        const Vec3 b(unit(engine), unit(engine), unit(engine));
        boxes.push_back(segment_box(a, a + 0.1 * b, 0.01));
    }
    return boxes;
}

Pairs brute_force(const std::vector<Box>& a, const std::vector<Box>& b, bool same) {
    Pairs pairs;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = same ? i + 1 : 0; j < b.size(); ++j) {
            if (overlap(a[i], b[j])) {
                pairs.emplace(static_cast<Index>(i), static_cast<Index>(j));
            }
        }
    }
    return pairs;
}

Pairs by_trees(const BoxTree& a, const BoxTree& b) {
    Pairs pairs;
    std::vector<BoxTree::Task> tasks;
    BoxTree::split(a, b, 50, tasks);
    for (const BoxTree::Task& task : tasks) {
        BoxTree::overlaps(a, b, task, [&](Index i, Index j) {
            const bool is_new =
                pairs.emplace(&a == &b ? std::min(i, j) : i, &a == &b ? std::max(i, j) : j).second;
            EXPECT_TRUE(is_new) << i << " " << j;
        });
    }
    return pairs;
}

} // namespace

TEST(Box, HoldsThePointsItWasMadeOfDespiteSinglePrecision) {
    std::mt19937 engine(2);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        const double x = unit(engine) * std::pow(10.0, 8.0 * unit(engine));
        EXPECT_LE(static_cast<double>(float_below(x)), x);
        EXPECT_GE(static_cast<double>(float_above(x)), x);
    }
    EXPECT_LT(float_below(0.0), 0.0F);
}

TEST(Box, OverlapsWhereItDoesOnEachAxis) {
    std::mt19937 engine(5);
    std::uniform_int_distribution<int> place(0, 4); // few, so that boxes touch, too
    std::vector<Box> boxes(4);
    int seen = 0;
    for (int round = 0; round < 2000; ++round) {
        FourBoxes four;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                boxes[i].low[k] = static_cast<float>(place(engine));
                boxes[i].high[k] = boxes[i].low[k] + static_cast<float>(place(engine)) / 2.0F;
            }
            if (i < 3) { // the last of the four stays empty
                four.set(i, boxes[i]);
            }
        }
        const Box& other = boxes[3];
        unsigned expected = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            bool meets = true;
            for (std::size_t k = 0; k < 3; ++k) {
                meets =
                    meets && boxes[i].low[k] <= other.high[k] && other.low[k] <= boxes[i].high[k];
            }
            EXPECT_EQ(overlap(boxes[i], other), meets);
            EXPECT_EQ(overlap(other, boxes[i]), meets);
            expected |= (meets ? 1U : 0U) << i;
            seen += meets ? 1 : 0;
        }
        EXPECT_EQ(overlaps_of(four, other), expected);
    }
    EXPECT_GT(seen, 100);
    EXPECT_FALSE(overlap(Box{}, boxes[0]));
}

TEST(BoxTree, FindsThePairsThatBruteForceFinds) {
    for (const std::size_t count : {1UL, 4UL, 5UL, 13UL, 700UL}) {
        const std::vector<Box> a = random_boxes(count, 1);
        const std::vector<Box> b = random_boxes(count / 2 + 1, 2);
        const BoxTree tree_a(a);
        const BoxTree tree_b(b);

        EXPECT_EQ(by_trees(tree_a, tree_b), brute_force(a, b, false)) << count;
        EXPECT_EQ(by_trees(tree_a, tree_a), brute_force(a, a, true)) << count;
    }
}

TEST(BoxTree, FindsThemStillAfterRefitting) {
    BoxTree tree(random_boxes(300, 3));
    const std::vector<Box> moved = random_boxes(300, 4);

    tree.refit(moved);

    EXPECT_EQ(by_trees(tree, tree), brute_force(moved, moved, true));
}

TEST(BoxTree, QueryFindsTheItemsThatMeetABox) {
    const std::vector<Box> boxes = random_boxes(500, 5);
    const BoxTree tree(boxes);

    for (const Box& box : random_boxes(50, 6)) {
        std::set<Index> found;
        tree.query(box, [&](Index i) { found.insert(i); });
        std::set<Index> expected;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            if (overlap(boxes[i], box)) {
                expected.insert(static_cast<Index>(i));
            }
        }
        EXPECT_EQ(found, expected);
    }
}

TEST(BoxTree, OfNothingMeetsNothing) {
    const BoxTree none(std::span<const Box>{});
    const BoxTree some(random_boxes(3, 1));

    EXPECT_TRUE(by_trees(none, some).empty());
    EXPECT_TRUE(by_trees(none, none).empty());
}

TEST(BoxTree, NearFindsTheNearestBoxLikeALoopOverAll) {
    const std::vector<Box> boxes = random_boxes(300, 8);
    const BoxTree tree{std::span<const Box>(boxes)};
    std::mt19937 engine(4);
    std::uniform_real_distribution<double> unit(-2.0, 2.0);

    for (int i = 0; i < 200; ++i) {
        const Vec3 p(unit(engine), unit(engine), unit(engine));
        double least = std::numeric_limits<double>::infinity();
        for (const Box& box : boxes) {
            least = std::min(least, distance_squared(box, p));
        }
        double limit = std::numeric_limits<double>::infinity();
        tree.near(p, limit, [&](Index item) {
            limit = std::min(limit, distance_squared(boxes[at(item)], p));
        });
        EXPECT_EQ(limit, least);
    }
}

} // namespace weft
