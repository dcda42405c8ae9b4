#pragma once

#include <time.h>

namespace sonarsim {

/// CPU time of this thread in seconds, which stays comparable on a busy machine.
inline double thread_seconds_now() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace sonarsim
