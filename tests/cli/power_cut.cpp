// A disk whose power goes off, for the tests of the command line: a library to be loaded before the
// others (LD_PRELOAD). It knows which files below a folder have become durable (fsync, fdatasync,
// syncfs), and at a given call it ends the program and leaves the folder as a disk may be found
// after a power cut: of what is not durable each piece is there, is not there, or is there in part,
// by the draws of a seed. The environment tells it what to do:
//   POWER_CUT_BELOW  only files below this folder count
//   POWER_CUT_CALL   the number, from 1, of the call that no longer returns; 0: none
//   POWER_CUT_SEED   of the draws
//   POWER_CUT_LOG    where the number of calls is written at the end of the program

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

template <class Function>
Function* next(Function*, const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

#define NEXT(function) next(&::function, #function)

std::string setting(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

/// The bytes that a write replaced in a file that was there before.
struct Overwritten {
    std::int64_t offset;
    std::string before;
};

/// A name that is not durable yet.
struct Pending {
    std::optional<std::string> before;     ///< former content of the name; nothing: it was free
    bool data_durable = false;             ///< the bytes are safe, the name alone is not
    bool renamed = false;                  ///< it may still stand for what it stood for before
    std::vector<Overwritten> overwritten;  ///< in a file whose name is durable
    std::int64_t durable_size = -1;        ///< size that survives a power cut
};

/// All that the library knows. It is never destroyed: files may be closed at the very end.
struct Disk {
    std::mutex mutex;
    std::string below = setting("POWER_CUT_BELOW");
    long cut = std::atol(setting("POWER_CUT_CALL").c_str());
    long calls = 0;
    std::uint64_t random = std::strtoull(setting("POWER_CUT_SEED").c_str(), nullptr, 10) + 1;
    std::map<std::string, Pending> pending;
};

Disk& disk() {
    static Disk* const the = new Disk;
    return *the;
}

bool is_below(std::string_view path) {
    return !disk().below.empty() && path.starts_with(disk().below);
}

std::string path_of(int fd) {
    char path[4096];
    const std::string link = "/proc/self/fd/" + std::to_string(fd);
    const ssize_t size = readlink(link.c_str(), path, sizeof path);
    return size < 0 ? std::string() : std::string(path, size);
}

std::optional<std::string> bytes_of(const std::string& path) {
    const int fd = NEXT(open)(path.c_str(), O_RDONLY | O_NOFOLLOW);
    if (fd < 0) return std::nullopt;
    std::string bytes;
    char part[65536];
    for (ssize_t got = 0; (got = read(fd, part, sizeof part)) > 0;)
        bytes.append(part, got);
    NEXT(close)(fd);
    return bytes;
}

void put_bytes(const std::string& path, std::string_view bytes) {
    const int fd = NEXT(open)(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (NEXT(write)(fd, bytes.data(), bytes.size()) < 0) std::abort();
    NEXT(close)(fd);
}

std::uint64_t draw(std::uint64_t below) {  // splitmix64
    std::uint64_t z = disk().random += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return (z ^ (z >> 31)) % below;
}

/// One name, as it is found after the cut.
void lose(const std::string& path, const Pending& what) {
    const std::uint64_t fate = draw(4);
    if (what.durable_size >= 0) {  // written into: each piece is there or not
        for (auto piece = what.overwritten.rbegin(); piece != what.overwritten.rend(); ++piece) {
            if (draw(2) == 0) continue;
            const int fd = NEXT(open)(path.c_str(), O_WRONLY);
            const auto size = static_cast<std::size_t>(piece->before.size());
            if (NEXT(pwrite)(fd, piece->before.data(), size, piece->offset) < 0) std::abort();
            NEXT(close)(fd);
        }
        if (fate == 0 && truncate(path.c_str(), what.durable_size) != 0) std::abort();
        return;
    }
    if (fate == 0) return;  // the disk was fast
    if (fate == 1 || what.data_durable) {
        // The name is lost: it stands for what it stood for.
        what.before ? put_bytes(path, *what.before) : void(NEXT(unlink)(path.c_str()));
        return;
    }
    const std::string bytes = bytes_of(path).value_or("");
    put_bytes(path,
              fate == 2 ? std::string_view() : std::string_view(bytes).substr(0, bytes.size() / 2));
}

/// Counts a call below the folder, and at its time ends the program.
void count() {
    if (++disk().calls != disk().cut) return;
    for (const auto& [path, what] : disk().pending)
        lose(path, what);
    syscall(SYS_exit_group, 99);  // at once: no sanitizer has a last word
}

/// The file gets new bytes, or is new.
Pending& touched(const std::string& path) {
    return disk().pending[path];
}

void note_open(const std::string& path, int flags) {
    if ((flags & O_ACCMODE) == O_RDONLY) return;
    if (disk().pending.contains(path)) return;
    struct stat status {};
    const bool there = lstat(path.c_str(), &status) == 0;
    if (!there) {
        touched(path);
    } else {
        touched(path).durable_size = status.st_size;
    }
}

/// Before `size` bytes at `offset` change.
void note_write(int fd, std::int64_t offset, std::size_t size) {
    const std::string path = path_of(fd);
    if (!is_below(path)) return;
    count();
    Pending& file = touched(path);
    file.data_durable = false;
    if (file.durable_size < 0) return;
    std::string before(size, '\0');
    const int reader = NEXT(open)(path.c_str(), O_RDONLY);
    const ssize_t got = pread(reader, before.data(), size, offset);
    NEXT(close)(reader);
    before.resize(got < 0 ? 0 : got);
    file.overwritten.push_back({offset, before});
}

/// The bytes of a file became durable.
void note_sync(const std::string& path) {
    const auto file = disk().pending.find(path);
    if (file == disk().pending.end()) return;
    if (file->second.durable_size >= 0) {
        disk().pending.erase(file);
    } else {
        file->second.data_durable = true;
    }
}

/// The names in a folder became durable.
void note_folder_sync(const std::string& folder) {
    for (auto& [path, what] : disk().pending) {
        if (path.substr(0, path.rfind('/')) != folder || !what.data_durable) continue;
        what.durable_size = -2;  // to be removed below
    }
    std::erase_if(disk().pending, [](const auto& one) { return one.second.durable_size == -2; });
}

mode_t mode_argument(int flags, std::va_list arguments) {
    return (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
}

template <class Open>
int open_noted(Open open, const char* path, int flags, mode_t mode) {
    const std::lock_guard lock(disk().mutex);
    if (is_below(path)) {
        if ((flags & O_ACCMODE) != O_RDONLY) count();
        note_open(path, flags);
    }
    return open(path, flags, mode);
}

struct AtEnd {
    ~AtEnd() {
        // A process that the program starts, such as a sanitizer's symbolizer, loads the library,
        // too, and ends later: it has no calls to tell of.
        if (!setting("POWER_CUT_LOG").empty() && disk().calls > 0)
            put_bytes(setting("POWER_CUT_LOG"), std::to_string(disk().calls));
    }
} at_end;

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
    std::va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = mode_argument(flags, arguments);
    va_end(arguments);
    return open_noted(NEXT(open), path, flags, mode);
}

int open64(const char* path, int flags, ...) {
    std::va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = mode_argument(flags, arguments);
    va_end(arguments);
    return open_noted(NEXT(open64), path, flags, mode);
}

// Streams write through calls inside the C library that cannot be stood in front of. Their files
// are new ones: to know their names is enough.
std::FILE* fopen(const char* path, const char* mode) {
    const std::lock_guard lock(disk().mutex);
    if (mode[0] != 'r' && is_below(path)) {
        count();
        note_open(path, O_WRONLY);
    }
    return NEXT(fopen)(path, mode);
}

ssize_t write(int fd, const void* bytes, std::size_t size) {
    const std::lock_guard lock(disk().mutex);
    note_write(fd, lseek(fd, 0, (fcntl(fd, F_GETFL) & O_APPEND) != 0 ? SEEK_END : SEEK_CUR), size);
    return NEXT(write)(fd, bytes, size);
}

ssize_t pwrite(int fd, const void* bytes, std::size_t size, off_t offset) {
    const std::lock_guard lock(disk().mutex);
    note_write(fd, offset, size);
    return NEXT(pwrite)(fd, bytes, size, offset);
}

int fsync(int fd) {
    const std::lock_guard lock(disk().mutex);
    const std::string path = path_of(fd);
    if (is_below(path)) count();
    const int result = NEXT(fsync)(fd);
    struct stat status {};
    const bool folder = fstat(fd, &status) == 0 && S_ISDIR(status.st_mode);
    folder ? note_folder_sync(path) : note_sync(path);
    return result;
}

int fdatasync(int fd) {
    const std::lock_guard lock(disk().mutex);
    const std::string path = path_of(fd);
    if (is_below(path)) count();
    note_sync(path);
    return NEXT(fdatasync)(fd);
}

int syncfs(int fd) noexcept {
    const std::lock_guard lock(disk().mutex);
    if (is_below(path_of(fd))) count();
    disk().pending.clear();
    return NEXT(syncfs)(fd);
}

int rename(const char* from, const char* to) noexcept {
    const std::lock_guard lock(disk().mutex);
    if (!is_below(to)) return NEXT(rename)(from, to);
    count();
    Pending moved;
    const auto old = disk().pending.find(from);
    moved.data_durable = old == disk().pending.end() || old->second.data_durable;
    const auto replaced = disk().pending.find(to);
    moved.before = replaced != disk().pending.end() ? replaced->second.before : bytes_of(to);
    const int result = NEXT(rename)(from, to);
    disk().pending.erase(from);
    disk().pending[to] = moved;
    return result;
}

int link(const char* from, const char* to) noexcept {
    const std::lock_guard lock(disk().mutex);
    if (!is_below(to)) return NEXT(link)(from, to);
    count();
    const int result = NEXT(link)(from, to);
    const auto old = disk().pending.find(from);
    if (result == 0) {
        disk().pending[to].data_durable =
            old == disk().pending.end() || old->second.data_durable;
    }
    return result;
}

int unlink(const char* path) noexcept {
    const std::lock_guard lock(disk().mutex);
    if (is_below(path)) {
        count();
        disk().pending.erase(path);
    }
    return NEXT(unlink)(path);
}

}  // extern "C"
