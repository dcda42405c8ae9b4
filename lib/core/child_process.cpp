#include "core/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
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
#include <utility>

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

/// The address space that this process uses, in bytes.
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

/// The processor time of this process, in whole seconds.
unsigned long cpu_used_s() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return static_cast<unsigned long>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
}

void read_all(int from, void* bytes, std::size_t size) {
    char* next = static_cast<char*>(bytes);
    while (size > 0) {
        const ssize_t count = read(from, next, size);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) _exit(0);  // the parent has no more requests
        next += count;
        size -= static_cast<std::size_t>(count);
    }
}

/// A request, and each piece of an answer, is preceded by its size. A size of 0 ends an answer.
using Size = std::uint64_t;

[[noreturn]] void run_child(const ChildProcess::Work& work, int channel,
                            const ChildLimits& limits) {
    for (const int number : {SIGINT, SIGTERM, SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGXCPU, SIGPIPE})
        std::signal(number, SIG_DFL);
    // The messages of a library that crashes would confuse the user.
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_AS, address_space() + limits.memory_bytes);
    try {
        for (;;) {
            Size size = 0;
            read_all(channel, &size, sizeof(size));
            std::string request(size, '\0');
            read_all(channel, request.data(), size);
            limit(RLIMIT_CPU, cpu_used_s() + limits.cpu_s);
            work(request, [channel](const void* bytes, Size count) {
                if (count == 0) return;
                write_all(channel, &count, sizeof(count));
                write_all(channel, bytes, count);
            });
            size = 0;
            write_all(channel, &size, sizeof(size));
        }
    } catch (...) {
        _exit(exit_threw);
    }
}

using Clock = std::chrono::steady_clock;

/// Waits until there are bytes to read, or the other end is closed. False after the deadline.
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

enum class Received { all, end, late };

/// Adds `size` bytes of the channel to `bytes`.
Received receive(int from, std::uint64_t size, std::optional<Clock::time_point> deadline,
                 std::string& bytes) {
    std::array<char, 1 << 16> buffer;
    while (size > 0) {
        if (deadline && !wait_for_bytes(from, *deadline)) return Received::late;
        const ssize_t count = read(from, buffer.data(), std::min<Size>(size, buffer.size()));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return Received::end;
        bytes.append(buffer.data(), static_cast<std::size_t>(count));
        size -= static_cast<Size>(count);
    }
    return Received::all;
}

/// Adds an answer to `bytes`.
Received receive_answer(int from, double wall_s, std::string& bytes) {
    std::optional<Clock::time_point> deadline;
    if (wall_s > 0.0) {
        deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(wall_s));
    }
    for (;;) {
        std::string head;
        const Received found = receive(from, sizeof(Size), deadline, head);
        if (found != Received::all) return found;
        Size size = 0;
        std::memcpy(&size, head.data(), sizeof(size));
        if (size == 0) return Received::all;
        const Received piece = receive(from, size, deadline, bytes);
        if (piece != Received::all) return piece;
    }
}

/// True if all bytes were sent.
bool send_all(int to, const std::string& bytes) {
    std::size_t sent = 0;
    while (sent < bytes.size()) {
        const ssize_t count = send(to, &bytes[sent], bytes.size() - sent, MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        sent += static_cast<std::size_t>(count);
    }
    return true;
}

int status_of(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

}  // namespace

ChildProcess::ChildProcess(Work work, const ChildLimits& limits)
    : work_(std::move(work)), limits_(limits) {}

ChildProcess::~ChildProcess() {
    end();
}

void ChildProcess::start() {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot make a channel");
    const pid_t child = fork();
    if (child < 0) {
        const int reason = errno;
        close(ends[0]);
        close(ends[1]);
        throw std::system_error(reason, std::generic_category(), "cannot start a process");
    }
    if (child == 0) {
        close(ends[0]);
        run_child(work_, ends[1], limits_);
    }
    close(ends[1]);
    child_ = child;
    channel_ = ends[0];
}

std::string ChildProcess::answer(const std::string& request) {
    if (child_ < 0) start();
    const Size size = request.size();
    const std::string head(reinterpret_cast<const char*>(&size), sizeof(size));
    std::string bytes;
    Received received = Received::end;
    if (send_all(channel_, head + request))
        received = receive_answer(channel_, limits_.wall_s, bytes);
    if (received != Received::all) refuse(received == Received::end);
    return bytes;
}

void ChildProcess::refuse(bool in_time) {
    if (!in_time) kill(child_, SIGKILL);
    const int status = status_of(child_);
    close(channel_);
    child_ = -1;
    if (!in_time) throw InputError("took more than " + number_text(limits_.wall_s) + " s");
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        throw InputError("took more than " + std::to_string(limits_.cpu_s) + " s");
    if (WIFSIGNALED(status))
        throw InputError(std::string("ended with \"") + sigdescr_np(WTERMSIG(status)) + "\"");
    throw InputError("needed more memory than it may have");
}

void ChildProcess::end() {
    if (child_ < 0) return;
    // Closing its channel would not end it: another child may have a copy of the channel.
    kill(child_, SIGKILL);
    status_of(child_);
    close(channel_);
    child_ = -1;
}

std::string bytes_of_child(const std::function<void(const ChildOutput&)>& work,
                           const ChildLimits& limits) {
    ChildProcess child([&](const std::string&, const ChildOutput& output) { work(output); },
                       limits);
    return child.answer("");
}

}  // namespace sonarsim
