#include "signals.h"

#include <csignal>

namespace sonarsim {

namespace {

// The only global state of the program: a signal handler can reach nothing else.
std::atomic<bool> stop = false;
std::atomic<int> received = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

extern "C" void on_signal(int number) {
    received = number;
    stop = true;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

std::atomic<bool>& stop_on_signal() {
    for (const int number : {SIGINT, SIGTERM}) {
        // A shell starts background jobs with SIGINT ignored, so that Ctrl-C spares them.
        if (std::signal(number, on_signal) == SIG_IGN) std::signal(number, SIG_IGN);
    }
    return stop;
}

int signal_received() {
    return received;
}

}  // namespace sonarsim
