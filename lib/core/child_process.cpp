#include "core/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>

#include "core/error.h"
#include "core/text.h"

namespace sonarsim {

namespace {

constexpr int exit_threw = 1;

void limit(int resource, rlim_t most) {
    rlimit both{};
    if (getrlimit(static_cast<__rlimit_resource_t>(resource), &both) != 0) return;
    both.rlim_cur = std::min(both.rlim_max, most);
    setrlimit(static_cast<__rlimit_resource_t>(resource), &both);
}

/// The address space that this process has already, in bytes.
std::size_t address_space() {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void write_all(int to, const void* bytes, std::size_t size) {
    const char* next = static_cast<const char*>(bytes);
    while (size > 0) {
        const ssize_t written = write(to, next, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) _exit(exit_threw);
        next += written;
        size -= static_cast<std::size_t>(written);
    }
}

[[noreturn]] void run_child(const std::function<void(const ChildOutput&)>& work, int to,
                            const ChildLimits& limits) {
    for (const int number : {SIGINT, SIGTERM, SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGXCPU, SIGPIPE})
        std::signal(number, SIG_DFL);
    // The last words of a library that dies would confuse the user.
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits.cpu_s);
    limit(RLIMIT_AS, address_space() + limits.memory_bytes);
    try {
        work([to](const void* bytes, std::size_t size) { write_all(to, bytes, size); });
    } catch (...) {
        _exit(exit_threw);
    }
    _exit(0);
}

using Clock = std::chrono::steady_clock;

/// Waits until there is something to read, or the other end is closed. False after the deadline.
bool wait_for_bytes(int from, Clock::time_point deadline) {
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
        if (left.count() <= 0) return false;
        pollfd one{.fd = from, .events = POLLIN, .revents = 0};
        // In steps of a second, since the milliseconds of poll() are an int.
        const int ready =
            poll(&one, 1, static_cast<int>(std::min<std::int64_t>(left.count(), 1000)));
        if (ready > 0 || (ready < 0 && errno != EINTR)) return true;
    }
}

/// All bytes up to the end; nothing if the deadline passes before.
std::optional<std::string> read_all(int from, std::optional<Clock::time_point> deadline) {
    std::string bytes;
    std::array<char, 1 << 16> buffer;
    for (;;) {
        if (deadline && !wait_for_bytes(from, *deadline)) return std::nullopt;
        const ssize_t count = read(from, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return bytes;
        bytes.append(buffer.data(), static_cast<std::size_t>(count));
    }
}

}  // namespace

std::string bytes_of_child(const std::function<void(const ChildOutput&)>& work,
                           const ChildLimits& limits) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
    const pid_t child = fork();
    if (child < 0) {
        const int reason = errno;
        close(ends[0]);
        close(ends[1]);
        throw std::system_error(reason, std::generic_category(), "cannot start a process");
    }
    if (child == 0) {
        close(ends[0]);
        run_child(work, ends[1], limits);
    }
    close(ends[1]);
    std::optional<Clock::time_point> deadline;
    if (limits.wall_s > 0.0) {
        deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(limits.wall_s));
    }
    std::optional<std::string> bytes = read_all(ends[0], deadline);
    close(ends[0]);
    if (!bytes) kill(child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!bytes) throw InputError("took more than " + number_text(limits.wall_s) + " s");
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return *std::move(bytes);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        throw InputError("took more than " + std::to_string(limits.cpu_s) + " s");
    if (WIFSIGNALED(status))
        throw InputError(std::string("ended with \"") + sigdescr_np(WTERMSIG(status)) + "\"");
    throw InputError("needed more memory than it may have");
}

}  // namespace sonarsim
