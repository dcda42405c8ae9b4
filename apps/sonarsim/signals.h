#pragma once

#include <atomic>
#include <string_view>

namespace sonarsim {

/// The first Ctrl-C (SIGINT) or SIGTERM sets the returned flag. If the program has not ended a
/// second later, as in a long ping, it writes `last_words` to stderr and exits with code 128 plus
/// the signal's number. A second signal ends the program at once.
std::atomic<bool>& stop_on_signal(std::string_view last_words);

/// The received signal, or 0.
int signal_received();

}  // namespace sonarsim
