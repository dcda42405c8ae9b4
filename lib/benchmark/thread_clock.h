#pragma once

#include <time.h>

namespace sonarsim {

/// Seconds of the processor that this thread has had: what can still be compared on a machine with
/// other work.
inline double thread_seconds_now() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace sonarsim
