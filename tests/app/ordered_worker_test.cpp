#include "app/ordered_worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace weft {
namespace {

TEST(OrderedWorker, RunsJobsInTheirOrder) {
    std::vector<int> order;
    OrderedWorker worker(2);

    for (int i = 0; i < 50; ++i) {
        worker.push([&order, i] { order.push_back(i); });
    }
    worker.finish();

    ASSERT_EQ(order.size(), 50U);
    for (int i = 0; i < 50; ++i) {
        EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
    }
}

TEST(OrderedWorker, LetsNoMoreJobsWaitThanItsCapacity) {
    std::atomic<int> waiting{0};
    int most = 0;
    OrderedWorker worker(3);

    for (int i = 0; i < 100; ++i) {
        worker.push([&] { --waiting; });
        most = std::max(most, ++waiting);
    }
    worker.finish();

    EXPECT_LE(most, 4); // three in the queue and one that has just left it
}

TEST(OrderedWorker, GivesAFailureToTheCallerAndDropsTheRest) {
    std::atomic<int> ran{0};
    OrderedWorker worker(10);
    worker.push([] { throw std::runtime_error("disk full"); });

    EXPECT_THROW(worker.finish(), std::runtime_error);
    EXPECT_THROW(worker.push([&] { ++ran; }), std::runtime_error);
    EXPECT_EQ(ran.load(), 0);
}

TEST(OrderedWorker, RunsWhatWaitsBeforeItGoes) {
    std::atomic<int> ran{0};
    {
        OrderedWorker worker(20);
        for (int i = 0; i < 20; ++i) {
            worker.push([&] { ++ran; });
        }
    }
    EXPECT_EQ(ran.load(), 20);
}

} // namespace
} // namespace weft
