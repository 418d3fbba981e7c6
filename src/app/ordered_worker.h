#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace weft {

/// One thread that runs jobs in the order they come, while the caller goes on. At most `capacity`
/// jobs wait; then push() does. When a job throws, the jobs after it are dropped and the next
/// push() or finish() throws the same.
class OrderedWorker {
public:
    explicit OrderedWorker(std::size_t capacity);
    /// Runs what waits; an exception that nobody asked for is lost.
    ~OrderedWorker();
    OrderedWorker(const OrderedWorker&) = delete;
    OrderedWorker& operator=(const OrderedWorker&) = delete;

    void push(std::function<void()> job);
    /// Waits until all jobs are done. Jobs may be pushed afterwards.
    void finish();

private:
    void run();
    void rethrow(std::unique_lock<std::mutex>& lock);

    std::size_t capacity_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> jobs_; ///< the first is being run
    std::exception_ptr failure_;
    bool closing_ = false;
    std::thread thread_; ///< last: starts when all else is ready
};

} // namespace weft
