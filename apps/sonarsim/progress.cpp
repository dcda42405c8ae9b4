#include "progress.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace sonarsim {

namespace {

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
