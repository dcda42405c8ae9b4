#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace sonarsim {

/// "12 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

/// Where progress is shown.
enum class ProgressTo {
    nowhere,
    terminal,  ///< one line, written anew
    log,       ///< a message every minute
};

/// A terminal where stderr is one, else the log; nowhere where `quiet`.
ProgressTo progress_of(bool quiet, bool json);

/// A stage of the work and the seconds that it took so far.
using StageSeconds = std::pair<std::string_view, double>;

/// Tells how many of `what` ("pings") are done, how fast, and how long the rest takes.
class ProgressLine {
  public:
    explicit ProgressLine(ProgressTo to, std::string what = "pings");
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// `stages` are told by their shares, the largest first.
    void show(std::uint64_t done, std::uint64_t total, std::span<const StageSeconds> stages = {});

  private:
    using Clock = std::chrono::steady_clock;

    ProgressTo to_;
    std::string what_;
    Clock::time_point start_;
    Clock::time_point next_;
};

}  // namespace sonarsim
