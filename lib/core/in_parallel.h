#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>

#include "core/thread_sanitizer.h"

namespace sonarsim {

/// Calls `body` for 0 to count - 1 on all threads of the arena, in any order.
template <class Body>
void in_parallel(std::size_t count, const Body& body) {
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
