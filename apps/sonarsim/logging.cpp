#include "logging.h"

#include <spdlog/fmt/chrono.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <regex>
#include <utility>

#include "core/text.h"

namespace sonarsim {

namespace {

/// On a terminal a message replaces the progress line.
std::string start_of_line() {
    return ::isatty(STDERR_FILENO) == 1 ? "\r\x1b[K" : "";
}

std::string_view view(const spdlog::string_view_t& text) {
    return {text.data(), text.size()};
}

/// A pattern that masks control characters, which messages may quote from files.
class TextFormatter : public spdlog::formatter {
  public:
    explicit TextFormatter(std::string pattern) : pattern_(std::move(pattern)), line_(pattern_) {}

    void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& out) override {
        const std::string text = printable(view(message.payload));
        spdlog::details::log_msg shown = message;
        shown.payload = text;
        line_.format(shown, out);
        message.color_range_start = shown.color_range_start;
        message.color_range_end = shown.color_range_end;
    }
    std::unique_ptr<spdlog::formatter> clone() const override {
        return std::make_unique<TextFormatter>(pattern_);
    }

  private:
    std::string pattern_;
    spdlog::pattern_formatter line_;
};

/// Adds fields for the start of a message: the number of a warning, and "file:line:column: ".
void add_fields(Json& line, std::string_view message) {
    static const std::regex code("(W[0-9]{2,3}) ");
    static const std::regex place("([^:\\s][^:]*):([0-9]{1,9})(:([0-9]{1,9}))?: ");
    std::cmatch found;
    const auto begins_with = [&](const std::regex& pattern) {
        return std::regex_search(message.data(), message.data() + message.size(), found, pattern,
                                 std::regex_constants::match_continuous);
    };
    if (begins_with(code)) {
        line["code"] = found[1].str();
        message.remove_prefix(found.length());
    }
    if (!begins_with(place)) return;
    line["file"] = found[1].str();
    line["line"] = std::stoi(found[2]);
    if (found[4].matched) line["column"] = std::stoi(found[4]);
}

class JsonFormatter : public spdlog::formatter {
  public:
    void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& out) override {
        const auto now = std::chrono::floor<std::chrono::milliseconds>(message.time);
        Json line;
        line["time"] = fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(now),
                                   now.time_since_epoch().count() % 1000);
        line["level"] = view(spdlog::level::to_string_view(message.level));
        line["message"] = view(message.payload);
        add_fields(line, view(message.payload));
        const std::string text = json_line(line) + "\n";
        out.append(text.data(), text.data() + text.size());
    }
    std::unique_ptr<spdlog::formatter> clone() const override {
        return std::make_unique<JsonFormatter>();
    }
};

constexpr int bar_width = 20;

std::string bar_of(std::uint64_t done, std::uint64_t total) {
    const auto filled =
        static_cast<std::size_t>(bar_width * static_cast<double>(done) /
                                 static_cast<double>(std::max<std::uint64_t>(1, total)));
    return "[" + std::string(filled, '#') + std::string(bar_width - filled, '.') + "]";
}

/// The width of the terminal: a longer line would not be overwritten.
std::size_t columns_of_terminal() {
    winsize size{};
    const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 1000;
}

}  // namespace

void add_log_options(CLI::App& command, LogOptions& options, LogResult result) {
    command.add_option("--log-level", options.level, "trace, debug, info, warning or error")
        ->check(CLI::IsMember({"trace", "debug", "info", "warning", "error"}))
        ->capture_default_str();
    const bool json = result == LogResult::text_or_json;
    command.add_flag("-q,--quiet", options.quiet,
                     json ? "Only warnings and errors; --json still prints its result"
                          : "Only warnings and errors");
    if (json)
        command.add_flag("--json", options.json,
                         "Log lines on stderr and the result on stdout as JSON");
}

void start_logging(const LogOptions& options) {
    auto logger = std::make_shared<spdlog::logger>(
        "sonarsim", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    if (options.json) {
        logger->set_formatter(std::make_unique<JsonFormatter>());
    } else {
        logger->set_formatter(std::make_unique<TextFormatter>(start_of_line() + "%^%l%$: %v"));
    }
    logger->set_level(options.quiet ? spdlog::level::warn : spdlog::level::from_str(options.level));
    spdlog::set_default_logger(std::move(logger));
}

std::size_t log_warnings(std::span<const Warning> warnings) {
    for (const Warning& warning : warnings)
        spdlog::warn("{}", sentence(warning));
    return warnings.size();
}

std::string warning_line(const LogOptions& options, const std::string& message) {
    if (options.json) return json_line({{"level", "warning"}, {"message", message}}) + "\n";
    return start_of_line() + "warning: " + message + "\n";
}

std::string result_line(std::string_view head, const std::string& rest) {
    return fmt::format("{:<11} {}\n", head, printable(rest));
}

void print_result(std::string_view head, const std::string& rest) {
    fmt::print("{}", result_line(head, rest));
}

std::string duration_text(double seconds) {
    const auto whole = std::llround(seconds);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string made_text(std::uint64_t made, std::uint64_t there, const char* how) {
    if (made == 0 && there > 0) return fmt::format("all of its {} pings were there already", there);
    const std::string rest = there > 0 ? fmt::format(", {} were there already", there) : "";
    return fmt::format("{} pings {}{}", made, how, rest);
}

ProgressLine::ProgressLine(const LogOptions& log, std::string what)
    : silent_(log.quiet),
      on_terminal_(!silent_ && !log.json && ::isatty(STDERR_FILENO) == 1),
      what_(std::move(what)),
      start_(Clock::now()),
      next_(start_ + (on_terminal_ ? Clock::duration(std::chrono::milliseconds(300))
                                   : Clock::duration(std::chrono::minutes(1)))) {}

ProgressLine::~ProgressLine() {
    if (on_terminal_) std::fputs("\r\x1b[K", stderr);
}

void ProgressLine::show(std::uint64_t done, std::uint64_t total) {
    const Clock::time_point now = Clock::now();
    if (silent_ || now < next_ || done == 0) return;
    const double rate =
        static_cast<double>(done) / std::chrono::duration<double>(now - start_).count();
    const std::string speed = rate < 0.1
                                  ? "one in " + duration_text(1.0 / rate)
                                  : fmt::format("{:.{}f} {}/s", rate, rate < 10.0 ? 2 : 0, what_);
    std::string text = fmt::format("{} of {} {}, {}, {} left", done, total, what_, speed,
                                   duration_text(static_cast<double>(total - done) / rate));
    if (!on_terminal_) {
        next_ = now + std::chrono::minutes(1);
        spdlog::info("{}", text);
        return;
    }
    next_ = now + std::chrono::milliseconds(100);
    text = bar_of(done, total) + " " + text;
    fmt::print(stderr, "\r\x1b[K{}", text.substr(0, columns_of_terminal() - 1));
    std::fflush(stderr);
}

}  // namespace sonarsim
