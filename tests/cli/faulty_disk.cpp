// A disk that fails, for the tests of the command line: a library to be loaded before the others
// (LD_PRELOAD) that replaces the C library's calls for writing. The environment says what it does:
//   FAULTY_DISK_BELOW  only files below this folder count
//   FAULTY_DISK_LOG    a line for each call that counts: its name and the file's
//   FAULTY_DISK_CALL   the number, from 1, of the call that is the first to fail; 0: none does
//   FAULTY_DISK_MODE   "full": that call and all later ones fail with ENOSPC
//                      "once": it alone fails, with EIO; "stall": it never comes back
//                      "short": a write takes half of what it is given
//                      "interrupted": every third one is, by a signal
//                      "readonly": every call fails, with EROFS
//                      "nolock": flock() alone fails, with ENOLCK

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

namespace {

std::string_view setting(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

template <class Function>
Function* next(Function*, const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

#define NEXT(function) next(&::function, #function)

std::atomic<long> calls = 0;

bool is_below(const char* path) {
    return !setting("FAULTY_DISK_BELOW").empty() &&
           std::string_view(path).starts_with(setting("FAULTY_DISK_BELOW"));
}

void log(const char* call, const char* path) {
    static const int to = NEXT(open)(std::string(setting("FAULTY_DISK_LOG")).c_str(),
                                     O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    const std::string line = std::string(call) + " " + path + "\n";
    if (NEXT(write)(to, line.data(), line.size()) < 0) std::abort();
}

/// Counts a call and says whether it has to fail; errno is set then.
bool fails(const char* call, const char* path) {
    const long number = ++calls;
    const long first = std::atol(std::string(setting("FAULTY_DISK_CALL")).c_str());
    log(call, path);
    if (setting("FAULTY_DISK_MODE") == "readonly") {
        errno = EROFS;
        return true;
    }
    while (number == first && setting("FAULTY_DISK_MODE") == "stall")
        pause();
    const bool full = setting("FAULTY_DISK_MODE") == "full";
    if (first == 0 || (full ? number < first : number != first)) return false;
    errno = full ? ENOSPC : EIO;
    return true;
}

/// The path of an open file or folder; empty if it has none.
std::string path_of(int fd) {
    std::array<char, 4096> path{};
    const std::string link = "/proc/self/fd/" + std::to_string(fd);
    return readlink(link.c_str(), path.data(), path.size() - 1) < 0 ? "" : path.data();
}

bool fails(const char* call, int fd) {
    return fails(call, path_of(fd).c_str());
}

bool is_below_open(int fd) {
    return is_below(path_of(fd).c_str());
}

bool writes_below(int fd) {
    return (fcntl(fd, F_GETFL) & O_ACCMODE) != O_RDONLY && is_below_open(fd);
}

/// The number of bytes that a write of `size` bytes takes; 0: it is interrupted, and errno is set.
std::size_t taken(std::size_t size) {
    if (setting("FAULTY_DISK_MODE") == "short") return (size + 1) / 2;
    if (setting("FAULTY_DISK_MODE") != "interrupted" || calls % 3 != 0) return size;
    errno = EINTR;
    return 0;
}

/// write() and pwrite(), which has an offset.
template <class Write, class... Offset>
ssize_t write_watched(const char* call, Write write, int fd, const void* bytes, std::size_t size,
                      Offset... offset) {
    if (!writes_below(fd)) return write(fd, bytes, size, offset...);
    if (fails(call, fd)) return -1;
    const std::size_t part = taken(size);
    return part == 0 && size > 0 ? -1 : write(fd, bytes, part, offset...);
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
    std::va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
    va_end(arguments);
    if ((flags & O_ACCMODE) != O_RDONLY && is_below(path) && fails("open", path)) return -1;
    return NEXT(open)(path, flags, mode);
}

// Streams do not fail: the test finds their names in the log, where it wants none.
#define LOGS(name)                                              \
    std::FILE* name(const char* path, const char* mode) {       \
        if (mode[0] != 'r' && is_below(path)) log(#name, path); \
        return NEXT(name)(path, mode);                          \
    }
LOGS(fopen)
LOGS(fopen64)

ssize_t write(int fd, const void* bytes, std::size_t size) {
    return write_watched("write", NEXT(write), fd, bytes, size);
}

ssize_t pwrite(int fd, const void* bytes, std::size_t size, off_t offset) {
    return write_watched("pwrite", NEXT(pwrite), fd, bytes, size, offset);
}

int close(int fd) {
    const bool failing = writes_below(fd) && fails("close", fd);
    const int reason = errno;
    const int result = NEXT(close)(fd);
    if (!failing) return result;
    errno = reason;
    return -1;
}

// Calls that fail or are done, where the file or folder lies below.
#define FAILS_OR_DOES(name, is_of_ours, at, parameters, ...) \
    int name parameters {                                    \
        if (is_of_ours(at) && fails(#name, at)) return -1;   \
        return NEXT(name)(__VA_ARGS__);                      \
    }
FAILS_OR_DOES(fsync, is_below_open, fd, (int fd), fd)
FAILS_OR_DOES(fdatasync, is_below_open, fd, (int fd), fd)
FAILS_OR_DOES(syncfs, is_below_open, fd, (int fd) noexcept, fd)
FAILS_OR_DOES(ftruncate, writes_below, fd, (int fd, off_t size) noexcept, fd, size)
FAILS_OR_DOES(rename, is_below, to, (const char* from, const char* to) noexcept, from, to)
FAILS_OR_DOES(link, is_below, to, (const char* from, const char* to) noexcept, from, to)
FAILS_OR_DOES(mkdir, is_below, path, (const char* path, mode_t mode) noexcept, path, mode)

int flock(int fd, int operation) noexcept {
    if (setting("FAULTY_DISK_MODE") == "nolock" && is_below_open(fd)) {
        errno = ENOLCK;
        return -1;
    }
    return NEXT(flock)(fd, operation);
}

}  // extern "C"
