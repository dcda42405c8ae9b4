#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace sonarsim {

/// "12 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

/// One line on a terminal that is written anew as `what` ("pings") are done; nothing where
/// `visible` is false.
class ProgressLine {
  public:
    explicit ProgressLine(bool visible, std::string what = "pings");
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void show(std::uint64_t done, std::uint64_t total);

  private:
    using Clock = std::chrono::steady_clock;

    bool visible_;
    std::string what_;
    Clock::time_point start_;
    Clock::time_point next_;
};

}  // namespace sonarsim
