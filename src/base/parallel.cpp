#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <memory>

namespace weft {

namespace {

std::unique_ptr<tbb::global_control>& limit() {
    static std::unique_ptr<tbb::global_control> control;
    return control;
}

} // namespace

void set_thread_count(int threads) {
    const auto count = threads > 0 ? threads : tbb::info::default_concurrency();
    limit().reset();
    limit() = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(count));
}

int thread_count() {
    return static_cast<int>(
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

} // namespace weft
