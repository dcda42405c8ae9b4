#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "run/checks/warning.h"

namespace sonarsim {

struct LogOptions {
    std::string level = "info";
    bool quiet = false;  ///< warnings and errors only
    bool json = false;   ///< one JSON object per line

    /// True if the command prints its result. --quiet suppresses text for people; a user of --json
    /// needs the result.
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

/// JSON on one line, with the line feed. Bytes that are not UTF-8, as in a file name, become
/// U+FFFD.
std::string json_line(const nlohmann::ordered_json& json);

}  // namespace sonarsim
