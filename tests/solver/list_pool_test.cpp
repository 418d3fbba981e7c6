#include <gtest/gtest.h>

#include <random>

#include "solver/list_pool.h"

namespace weft {

TEST(ListPool, HoldsWhatSortedVectorsWould) {
    std::mt19937 random(1);
    std::vector<std::vector<int>> expected(20);
    ListPool<int> pool;
    const std::vector<std::uint32_t> lengths(10, 0);
    pool.reset(lengths);
    for (int i = 0; i < 10; ++i) {
        pool.add_list();
    }
    for (int step = 0; step < 5000; ++step) {
        const std::size_t list = random() % expected.size();
        std::vector<int>& row = expected[list];
        const int dice = static_cast<int>(random() % 20);
        if (dice == 0) {
            row.assign(random() % 30, 7);
            pool.assign(list, row);
        } else if (dice < 11 || row.empty()) {
            const int item = static_cast<int>(random() % 50);
            row.insert(std::upper_bound(row.begin(), row.end(), item), item);
            pool.insert(list, item);
        } else {
            const int item = row[random() % row.size()];
            row.erase(std::lower_bound(row.begin(), row.end(), item));
            pool.erase(list, item);
        }
        pool.keep_room_to_spare(step % 100 < 50);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            ASSERT_TRUE(std::ranges::equal(pool[i], expected[i]));
        }
    }
}

} // namespace weft
