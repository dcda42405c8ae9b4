#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>

#include "commands.h"

namespace sonarsim {

namespace {

// The only global state of the program; a signal handler cannot reach any other.
std::atomic<bool> stop_requested = false;
std::atomic<int> received = 0;
std::array<char, 512> last_text;
std::atomic<std::size_t> last_size = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
              std::atomic<std::size_t>::is_always_lock_free);

// A handler may call only functions that POSIX lists as safe: signal, alarm, write and _exit are.

extern "C" void on_signal(int number) {
    received = number;
    stop_requested = true;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    ::alarm(1);
}

/// Ends the program a second after the signal. This is safe between any two instructions, as a kill
/// or a power cut is: a file gets its name after all of its bytes are written, and the journal
/// names a ping after that, so that the next run continues from the whole files.
extern "C" void on_alarm(int) {
    const ssize_t written = ::write(STDERR_FILENO, last_text.data(), last_size);
    static_cast<void>(written);  // the program ends in any case
    ::_exit(exit_signal + received);
}

}  // namespace

std::atomic<bool>& stop_on_signal(std::string_view last_words) {
    last_size = last_words.copy(last_text.data(), last_text.size());
    std::signal(SIGALRM, on_alarm);
    for (const int number : {SIGINT, SIGTERM}) {
        // A shell ignores SIGINT for background jobs, so that Ctrl-C does not end them.
        if (std::signal(number, on_signal) == SIG_IGN) std::signal(number, SIG_IGN);
    }
    return stop_requested;
}

int exit_code_of_signal() {
    return exit_signal + received;
}

}  // namespace sonarsim
