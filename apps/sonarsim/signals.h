#pragma once

#include <atomic>
#include <string_view>

namespace sonarsim {

/// From here on the first Ctrl-C (SIGINT) or SIGTERM sets the returned flag. Where the program has
/// not ended a second later - a scene takes long to load, a ping long to render - it is ended on
/// the spot with exit code 128 plus the signal's number, after `last_words` on stderr. A second
/// signal ends it at once.
std::atomic<bool>& stop_on_signal(std::string_view last_words);

/// The signal that came, or 0.
int signal_received();

}  // namespace sonarsim
