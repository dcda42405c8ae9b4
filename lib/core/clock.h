#pragma once

#include <chrono>
#include <utility>

namespace sonarsim {

/// Seconds of a monotonic clock; its zero is arbitrary.
inline double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Times consecutive steps of a piece of work.
class Stopwatch {
  public:
    /// Seconds since the last call, or since construction.
    double lap() {
        const double now = seconds_now();
        return now - std::exchange(last_, now);
    }

  private:
    double last_ = seconds_now();
};

}  // namespace sonarsim
