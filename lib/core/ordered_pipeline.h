#pragma once

#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>

#include <atomic>
#include <cstddef>
#include <optional>
#include <vector>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SONARSIM_THREAD_SANITIZER
#endif
#endif

// Marks a function that TBB calls. Such a function reads its arguments before it can call
// tsan_acquire(), and the thread sanitizer would report this. The sanitizer skips the function
// itself and still checks everything that it calls.
#ifdef SONARSIM_THREAD_SANITIZER
#define SONARSIM_CALLED_BY_TBB __attribute__((no_sanitize("thread")))
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#else
#define SONARSIM_CALLED_BY_TBB
#endif

namespace sonarsim {

// Debian's TBB is not built for the thread sanitizer, so the sanitizer does not see that TBB orders
// the threads it hands work to. These announce that order; in other builds they do nothing.

/// Makes what this thread has written visible to those that call tsan_acquire() with this address.
inline void tsan_release([[maybe_unused]] const void* address) {
#ifdef SONARSIM_THREAD_SANITIZER
    __tsan_release(const_cast<void*>(address));
#endif
}

inline void tsan_acquire([[maybe_unused]] const void* address) {
#ifdef SONARSIM_THREAD_SANITIZER
    __tsan_acquire(const_cast<void*>(address));
#endif
}

/// Calls tsan_release() at the end of a scope, even if an exception ends it.
struct ReleaseAtEnd {
    const void* address;
    ~ReleaseAtEnd() { tsan_release(address); }
};

/// Calls tsan_acquire() at the end of a scope, even if an exception ends it.
struct AcquireAtEnd {
    const void* address;
    ~AcquireAtEnd() { tsan_acquire(address); }
};

/// Calls `work(i)` for 0 to count - 1, several at a time on the threads of the arena, and `finish`
/// with each result, one at a time and in the order of i. At most `in_flight` results exist at
/// once. When `stop` becomes true, no more work begins, and the work in flight is finished. An
/// exception of `work` or `finish` ends the call after the work in flight.
void ordered_pipeline(std::size_t count, std::size_t in_flight, const std::atomic<bool>& stop,
                      const auto& work, const auto& finish) {
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
    std::vector<std::optional<decltype(work(0))>> results(in_flight);
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

/// Calls `body` for 0 to count - 1 on all threads of the arena, in any order.
void in_parallel(std::size_t count, const auto& body) {
    char begun = 0;
    char done = 0;
    const AcquireAtEnd all{&done};
    tsan_release(&begun);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) SONARSIM_CALLED_BY_TBB {
        tsan_acquire(&begun);
        const ReleaseAtEnd one{&done};
        body(i);
    });
}

}  // namespace sonarsim
