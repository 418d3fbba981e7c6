#include "app/ordered_worker.h"

#include <cassert>

namespace weft {

OrderedWorker::OrderedWorker(std::size_t capacity)
    : capacity_(capacity), thread_([this] { run(); }) {
    assert(capacity > 0);
}

OrderedWorker::~OrderedWorker() {
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void OrderedWorker::push(std::function<void()> job) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failure_ || jobs_.size() < capacity_; });
    rethrow(lock);
    jobs_.push_back(std::move(job));
    lock.unlock();
    changed_.notify_all();
}

void OrderedWorker::finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failure_ || jobs_.empty(); });
    rethrow(lock);
}

void OrderedWorker::rethrow(std::unique_lock<std::mutex>& lock) {
    assert(lock.owns_lock());
    if (failure_) {
        std::rethrow_exception(failure_);
    }
}

void OrderedWorker::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return closing_ || !jobs_.empty(); });
        if (jobs_.empty()) {
            return;
        }
        std::function<void()>& job = jobs_.front(); // stays in the queue: it still counts
        lock.unlock();
        std::exception_ptr failure;
        try {
            job();
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        jobs_.pop_front();
        if (failure) {
            failure_ = failure;
            jobs_.clear();
        }
        changed_.notify_all();
    }
}

} // namespace weft
