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

/// The place where progress is shown.
enum class ProgressTo {
    nowhere,
    terminal,  ///< one line that is rewritten
    log,       ///< a message every minute
};

/// The terminal if stderr is one, else the log; nowhere with `quiet`.
ProgressTo progress_of(bool quiet, bool json);

/// A stage of the work and its seconds so far.
using StageSeconds = std::pair<std::string_view, double>;

/// Shows how many of `what` ("pings") are done, the rate, and the time left.
class ProgressLine {
  public:
    explicit ProgressLine(ProgressTo to, std::string what = "pings");
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Shows the shares of `stages`, the largest first.
    void show(std::uint64_t done, std::uint64_t total, std::span<const StageSeconds> stages = {});

  private:
    using Clock = std::chrono::steady_clock;

    ProgressTo to_;
    std::string what_;
    Clock::time_point start_;
    Clock::time_point next_;
};

}  // namespace sonarsim
