#pragma once

#include <chrono>
#include <utility>

namespace sonarsim {

/// Seconds of a clock that only goes forward, from a start that means nothing.
inline double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Times the steps of a piece of work, one after the other.
class Stopwatch {
  public:
    /// Seconds since the last call, or since the stopwatch was made.
    double lap() {
        const double now = seconds_now();
        return now - std::exchange(last_, now);
    }

  private:
    double last_ = seconds_now();
};

}  // namespace sonarsim
