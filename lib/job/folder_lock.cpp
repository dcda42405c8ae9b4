#include "job/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "dataset/layout.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds pause_between_tries(20);

enum class Lock { taken, busy, unknown };

/// `unknown`: the file system has no locks (ENOLCK, EOPNOTSUPP), or the call failed.
Lock lock_now(int fd, int mode) {
    while (::flock(fd, mode | LOCK_NB) != 0) {
        if (errno == EINTR) continue;
        return errno == EWOULDBLOCK ? Lock::busy : Lock::unknown;
    }
    return Lock::taken;
}

/// Makes a folder and those above it. InputError for a path that cannot be a folder; errors of the
/// disk are passed on.
void make_folder(const fs::path& folder) {
    try {
        fs::create_directories(folder);
    } catch (const fs::filesystem_error& error) {
        for (const std::errc fault :
             {std::errc::permission_denied, std::errc::operation_not_permitted,
              std::errc::read_only_file_system, std::errc::no_such_file_or_directory,
              std::errc::not_a_directory, std::errc::filename_too_long}) {
            if (error.code() != fault) continue;
            throw InputError({folder.string()},
                             "cannot make this folder: " + error.code().message() +
                                 "; choose another output.folder (--out)");
        }
        throw;
    }
}

}  // namespace

FolderLock::FolderLock(fs::path folder) : folder_(std::move(folder)) {
    open();
}

FolderLock::~FolderLock() {
    close();
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : folder_(std::move(other.folder_)), fd_(std::exchange(other.fd_, -1)), works_(other.works_) {}

void FolderLock::open() {
    while (fd_ < 0) {
        if (fs::exists(folder_) && !fs::is_directory(folder_))
            throw InputError({folder_.string()}, "is not a folder");
        make_folder(folder_);
        fd_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        // Another run may have removed it again.
        if (fd_ < 0 && errno != ENOENT) throw_errno("cannot open", folder_);
    }
}

void FolderLock::close() {
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
}

bool FolderLock::try_lock(int mode) {
    const Lock lock = lock_now(fd_, mode);
    works_ = lock != Lock::unknown;
    return lock != Lock::busy;
}

/// True if the open folder still has its name: a run with --overwrite may remove folders.
bool FolderLock::is_in_place() const {
    struct stat opened {};
    struct stat named {};
    return ::fstat(fd_, &opened) == 0 && ::stat(folder_.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

bool FolderLock::take(std::initializer_list<int> modes, const Waits& waits) {
    for (;;) {
        if (std::ranges::any_of(modes, [this](int mode) { return try_lock(mode); })) {
            if (is_in_place()) return true;
            close();
            open();
            continue;
        }
        if (!waits()) return false;
        std::this_thread::sleep_for(pause_between_tries);
    }
}

bool FolderLock::take_alone(const Waits& waits) {
    return take({LOCK_EX}, waits);
}

bool FolderLock::share(const Waits& waits) {
    return take({LOCK_SH}, waits);
}

bool FolderLock::take_alone_or_share(const Waits& waits) {
    return take({LOCK_EX, LOCK_SH}, waits);
}

FolderLock lock_alone(const fs::path& folder) {
    FolderLock lock(folder);
    if (!lock.take_alone([] { return false; }) || others_write(folder, 1))
        refuse_second_run(folder);
    return lock;
}

std::optional<FolderLock> lock_for_run(const fs::path& folder, int shards,
                                       const std::atomic<bool>& stop) {
    if (shards == 1) return lock_alone(folder);
    const auto is_taken = [&] { return others_write(folder, shards); };
    FolderLock lock(folder);
    const bool entered = lock.take_alone_or_share([&] { return !stop && !is_taken(); });
    if (!entered && stop) return std::nullopt;
    if (!entered || is_taken()) refuse_second_run(folder);
    return lock;
}

void refuse_second_run(const fs::path& folder) {
    throw InputError({folder.string()},
                     "another run is writing into this folder; wait until it has ended, or choose "
                     "another output.folder");
}

Warning no_locks_warning(const fs::path& folder) {
    return make_warning(WarningCode::no_locks, folder.string());
}

bool lock_file(int fd, bool& works) {
    // is_locked() holds a lock for a moment.
    constexpr int tries = 50;
    Lock lock = lock_now(fd, LOCK_EX);
    for (int i = 1; i < tries && lock == Lock::busy; ++i) {
        std::this_thread::sleep_for(pause_between_tries);
        lock = lock_now(fd, LOCK_EX);
    }
    works = lock != Lock::unknown;
    return lock != Lock::busy;
}

bool is_locked(const fs::path& file) {
    const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (fd < 0) return false;
    const bool locked = lock_now(fd, LOCK_SH) == Lock::busy;
    ::close(fd);
    return locked;
}

bool others_write(const fs::path& folder, int shards) {
    return std::ranges::any_of(journal_parts(folder), [&](const fs::path& part) {
        const bool same_division = shards > 1 && shard_of_part(part)->second == shards;
        return !same_division && is_locked(part);
    });
}

}  // namespace sonarsim
