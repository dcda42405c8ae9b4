#pragma once

#include <tbb/parallel_pipeline.h>

#include <atomic>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <vector>

#include "core/thread_sanitizer.h"

namespace sonarsim {

/// Calls `work(i)` for 0 to count - 1, several at a time on the threads of the arena, and `finish`
/// with each result, one at a time and in the order of i. At most `in_flight` results exist at
/// once. When `stop` becomes true, no more work begins, and the work in flight is finished. An
/// exception of `work` or `finish` ends the call after the work in flight.
template <class Work, class Finish>
void ordered_pipeline(std::size_t count, std::size_t in_flight, const std::atomic<bool>& stop,
                      const Work& work, const Finish& finish) {
    using Result = std::invoke_result_t<const Work&, std::size_t>;
    // Their addresses also identify the handovers between threads.
    std::size_t next = 0;
    char done = 0;
    const auto feed = [&](tbb::flow_control& flow) SONARSIM_CALLED_BY_TBB -> std::size_t {
        tsan_acquire(&next);
        tsan_acquire(&done);  // the slot of the result that was finished
        const ReleaseAtEnd fed{&done};
        if (next == count || stop) {
            flow.stop();
            return 0;
        }
        const ReleaseAtEnd more{&next};
        return next++;
    };
    // Results wait in slots of our own, since TBB does not destroy what it still holds when an
    // exception ends the pipeline. Results leave in order, so those in flight have different slots.
    std::vector<std::optional<Result>> results(in_flight);
    const auto run = [&](std::size_t i) SONARSIM_CALLED_BY_TBB {
        tsan_acquire(&next);
        const ReleaseAtEnd ran{&done};
        results[i % in_flight].emplace(work(i));
        return i;
    };
    const auto take = [&](std::size_t i) SONARSIM_CALLED_BY_TBB {
        tsan_acquire(&done);
        const ReleaseAtEnd taken{&done};
        finish(*results[i % in_flight]);
        results[i % in_flight].reset();
    };
    const AcquireAtEnd all{&done};
    tsan_release(&next);
    tbb::parallel_pipeline(
        in_flight,
        tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, feed) &
            tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, run) &
            tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, take));
}

}  // namespace sonarsim
