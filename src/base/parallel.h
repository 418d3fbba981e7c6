#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

/// Parallel loops whose results do not depend on the number of threads: the range is always cut
/// into the same chunks, and what chunks return is combined in the order of the chunks.
namespace weft {

/// Threads that every loop below may use; 0 = all cores. Lasts until the next call.
void set_thread_count(int threads);
int thread_count();

/// Elements a chunk. Smaller: scheduling costs more than the work; larger: threads idle at the end.
inline constexpr std::size_t k_chunk = 256;

/// Calls f(begin, end) for each chunk of [0, count).
template <typename F>
void parallel_chunks(std::size_t count, const F& f, std::size_t chunk = k_chunk) {
    const std::size_t chunks = (count + chunk - 1) / chunk;
    if (chunks <= 1) {
        if (count > 0) {
            f(std::size_t{0}, count);
        }
        return;
    }
    tbb::parallel_for(
        std::size_t{0}, chunks,
        [&](std::size_t c) { f(c * chunk, std::min(count, (c + 1) * chunk)); },
        tbb::simple_partitioner());
}

/// Calls f(i) for each i in [0, count).
template <typename F>
void parallel_for(std::size_t count, const F& f, std::size_t chunk = k_chunk) {
    parallel_chunks(
        count,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                f(i);
            }
        },
        chunk);
}

/// Folds f(i) over [0, count): within a chunk in order, then the chunks in order, with combine(a,
/// b).
template <typename T, typename F, typename C>
T parallel_reduce(
    std::size_t count, T zero, const F& f, const C& combine, std::size_t chunk = 1024) {
    const std::size_t chunks = (count + chunk - 1) / chunk;
    std::vector<T> partial(chunks, zero);
    parallel_chunks(
        count,
        [&](std::size_t begin, std::size_t end) {
            T total = zero;
            for (std::size_t i = begin; i < end; ++i) {
                total = combine(total, f(i));
            }
            partial[begin / chunk] = total;
        },
        chunk);
    T total = zero;
    for (const T& part : partial) {
        total = combine(total, part);
    }
    return total;
}

/// The lists that the chunks of parallel_collect() fill: kept between calls, their memory is used
/// again.
template <typename T> using ChunkLists = std::vector<std::vector<T>>;

/// Calls f(i, list) for each i in [0, count), which may append to the list, and appends to `out`
/// what all have appended, in the order of i.
template <typename T, typename F>
void parallel_collect(std::size_t count,
                      const F& f,
                      ChunkLists<T>& lists,
                      std::vector<T>& out,
                      std::size_t chunk = 512) {
    const std::size_t chunks = (count + chunk - 1) / chunk;
    lists.resize(std::max(lists.size(), chunks));
    parallel_chunks(
        count,
        [&](std::size_t begin, std::size_t end) {
            std::vector<T>& list = lists[begin / chunk];
            list.clear();
            for (std::size_t i = begin; i < end; ++i) {
                f(i, list);
            }
        },
        chunk);
    for (std::size_t c = 0; c < chunks; ++c) {
        out.insert(out.end(), lists[c].begin(), lists[c].end());
    }
}

/// Sum of f(i) over [0, count), the same bits for any thread count.
template <typename F> double parallel_sum(std::size_t count, const F& f) {
    return parallel_reduce(count, 0.0, f, [](double a, double b) { return a + b; });
}

} // namespace weft
