#pragma once

#include <tbb/parallel_pipeline.h>

#include <atomic>
#include <cstddef>
#include <type_traits>

#include "core/handover.h"

namespace sonarsim {

/// Calls `work(i)` for 0 to count - 1, several at a time on the threads of the arena, and `finish`
/// with each result, one at a time and in the order of i. At most `in_flight` results exist at
/// once. When `stop` becomes true no more work begins, and what has begun is finished. An exception
/// of `work` or `finish` ends the call once the work in flight is done.
template <class Work, class Finish>
void ordered_pipeline(std::size_t count, std::size_t in_flight, const std::atomic<bool>& stop,
                      const Work& work, const Finish& finish) {
    using Result = std::invoke_result_t<const Work&, std::size_t>;
    // Besides their use, the addresses of these two name what is handed from thread to thread.
    std::size_t next = 0;
    char done = 0;
    const auto feed = [&](tbb::flow_control& flow) -> std::size_t {
        received(&next);
        const HandOverAtEnd fed{&done};
        if (next == count || stop) {
            flow.stop();
            return 0;
        }
        const HandOverAtEnd more{&next};
        return next++;
    };
    const auto run = [&](std::size_t i) {
        received(&next);
        const HandOverAtEnd ran{&done};
        return work(i);
    };
    const auto take = [&](const Result& result) {
        received(&done);
        const HandOverAtEnd taken{&done};
        finish(result);
    };
    const ReceiveAtEnd all{&done};
    handed_over(&next);
    tbb::parallel_pipeline(
        in_flight, tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, feed) &
                       tbb::make_filter<std::size_t, Result>(tbb::filter_mode::parallel, run) &
                       tbb::make_filter<Result, void>(tbb::filter_mode::serial_in_order, take));
}

}  // namespace sonarsim
