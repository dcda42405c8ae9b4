#pragma once

#include <atomic>

namespace sonarsim {

/// From here on the first Ctrl-C (SIGINT) or SIGTERM sets the returned flag; the second ends the
/// program at once.
std::atomic<bool>& stop_on_signal();

/// The signal that came, or 0.
int signal_received();

}  // namespace sonarsim
