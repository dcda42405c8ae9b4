#include "progress.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace sonarsim {

std::string duration_text(double seconds) {
    const auto whole = std::llround(seconds);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

ProgressLine::ProgressLine(bool visible, std::string what)
    : visible_(visible),
      what_(std::move(what)),
      start_(Clock::now()),
      next_(start_ + std::chrono::milliseconds(300)) {}

ProgressLine::~ProgressLine() {
    if (visible_) std::fputs("\r\x1b[K", stderr);
}

void ProgressLine::show(std::uint64_t done, std::uint64_t total) {
    const Clock::time_point now = Clock::now();
    if (!visible_ || now < next_ || done == 0) return;
    next_ = now + std::chrono::milliseconds(100);
    const double rate =
        static_cast<double>(done) / std::chrono::duration<double>(now - start_).count();
    fmt::print(stderr, "\r\x1b[K{} of {} {}, {:.0f} {}/s, {} left", done, total, what_, rate, what_,
               duration_text(static_cast<double>(total - done) / rate));
    std::fflush(stderr);
}

}  // namespace sonarsim
