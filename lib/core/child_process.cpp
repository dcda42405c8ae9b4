#include "core/child_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <system_error>

#include "core/error.h"

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

std::string read_all(int from) {
    std::string bytes;
    std::array<char, 1 << 16> buffer;
    for (;;) {
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
    std::string bytes = read_all(ends[0]);
    close(ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return bytes;
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        throw InputError("took more than " + std::to_string(limits.cpu_s) + " s");
    if (WIFSIGNALED(status))
        throw InputError(std::string("ended with \"") + sigdescr_np(WTERMSIG(status)) + "\"");
    throw InputError("needed more memory than it may have");
}

}  // namespace sonarsim
