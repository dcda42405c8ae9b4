#pragma once

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <cstdint>
#include <functional>

namespace sonarsim {

/// Called after each item with the number of items that are done and of all items to do: from any
/// thread, but never twice at a time, and in ascending order.
using ProgressCallback = std::function<void(std::uint64_t done, std::uint64_t total)>;

/// Calls `work(n)` in an arena of n threads: `threads`, or one per core if that is 0.
template <class Work>
void on_threads(int threads, const Work& work) {
    const int n = threads > 0 ? threads : tbb::info::default_concurrency();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, n);
    tbb::task_arena(n).execute([&] { work(n); });
}

}  // namespace sonarsim
