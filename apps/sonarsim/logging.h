#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "output/dataset/json.h"
#include "run/checks/warning.h"
#include "run/job/parallel.h"

namespace sonarsim {

struct LogOptions {
    std::string level = "info";
    bool quiet = false;  ///< warnings and errors only
    bool json = false;   ///< one JSON object per line

    /// --quiet suppresses text for people; a user of --json needs the result.
    bool prints_result() const { return json || !quiet; }
};

/// The form of a command's result: text, or with --json JSON.
enum class LogResult { text, text_or_json };

/// Adds --log-level, --quiet and perhaps --json to a subcommand.
void add_log_options(CLI::App& command, LogOptions& options,
                     LogResult result = LogResult::text_or_json);

/// Sends spdlog's default logger to stderr, as text or as JSON.
void start_logging(const LogOptions& options);

/// Logs each warning as a sentence. Returns their number.
std::size_t log_warnings(std::span<const Warning> warnings);

/// Formats a warning as a log line for a signal handler, which cannot log. As JSON it has no time.
std::string warning_line(const LogOptions& options, const std::string& message);

/// A line of a result for people: "mission     hull". Control characters are masked.
std::string result_line(std::string_view head, const std::string& rest);

/// Prints a result_line().
void print_result(std::string_view head, const std::string& rest);

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
