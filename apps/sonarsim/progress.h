#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "logging.h"
#include "run/job/parallel.h"

namespace sonarsim {

/// A duration as text: "12 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

/// "30 pings rendered, 12 were there already".
std::string made_text(std::uint64_t made, std::uint64_t there, const char* how = "rendered");

/// Shows the number of `what` ("pings") that are done, the rate and the time left: in one line that
/// is rewritten if stderr is a terminal, else in a message every minute; not at all with --quiet.
class ProgressLine {
  public:
    explicit ProgressLine(const LogOptions& log, std::string what = "pings");
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void show(std::uint64_t done, std::uint64_t total);
    /// Calls show(). The line must outlive it.
    ProgressCallback callback() {
        return [this](std::uint64_t done, std::uint64_t total) { show(done, total); };
    }

  private:
    using Clock = std::chrono::steady_clock;

    bool silent_;
    bool on_terminal_;
    std::string what_;
    Clock::time_point start_;
    Clock::time_point next_;
};

}  // namespace sonarsim
