#include "run/job/shard_lock.h"

#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

#include "core/error.h"
#include "core/file.h"
#include "output/dataset/layout.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

/// 0, EWOULDBLOCK where another run has the lock, or an error without locks (ENOLCK, EOPNOTSUPP).
int lock_now(int fd, int mode) {
    int result = 0;
    do {
        result = ::flock(fd, mode | LOCK_NB);
    } while (result != 0 && errno == EINTR);
    return result == 0 ? 0 : errno;
}

bool is_locked(const fs::path& part) {
    const Descriptor file(part, O_RDONLY | O_NOFOLLOW);
    return file.get() >= 0 && lock_now(file.get(), LOCK_SH) == EWOULDBLOCK;
}

/// True if a run of another division than `shards` writes here; `own` is this run's part.
bool others_write(const fs::path& folder, const fs::path& own, int shards) {
    const std::string division = "-of-" + std::to_string(shards) + ".txt";
    return std::ranges::any_of(journal_parts(folder), [&](const fs::path& part) {
        const bool same_division = shards > 1 && part.string().ends_with(division);
        return !same_division && part != own && is_locked(part);
    });
}

/// InputError for a path that cannot be a folder; errors of the disk are passed on.
void make_folder(const fs::path& folder) try {
    fs::create_directories(folder);
} catch (const fs::filesystem_error& error) {
    if (error.code() == std::errc::io_error || error.code() == std::errc::no_space_on_device) throw;
    throw InputError({folder.string()}, "cannot make this folder: " + error.code().message() +
                                            "; choose another output.folder (--out)");
}

/// True if the open file still has its name: the run that completes a dataset removes the parts.
bool is_in_place(int fd, const fs::path& path) {
    struct stat opened {};
    struct stat named {};
    return ::fstat(fd, &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

ShardLock::ShardLock(const fs::path& folder, int shard, int shards)
    : folder_(folder), part_(folder / journal_folder_name / journal_part(shard + 1, shards)) {
    // Others hold a lock for a moment to see whether this one is free. Two runs that exclude each
    // other and begin at once both give way and come again at different times.
    constexpr int tries = 20;
    require_no_link(part_.parent_path(), "a dataset");
    require_no_link(part_, "a dataset");
    std::minstd_rand random{std::random_device{}()};
    for (int i = 0; i < tries; ++i) {
        if (take(shards)) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(5 + random() % 40));
    }
    throw InputError({folder.string()},
                     "another run is writing into this folder; wait until it has ended, or choose "
                     "another output.folder");
}

ShardLock::~ShardLock() {
    release();
}

bool ShardLock::take(int shards) {
    make_folder(folder_);
    if (others_write(folder_, part_, shards)) return false;  // before a file is made
    if (::mkdir(part_.parent_path().c_str(), 0777) != 0 && errno != EEXIST)
        throw_errno("cannot write", part_);
    fd_ = ::open(part_.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (fd_ < 0) {
        if (errno == ENOENT) return false;  // another run has removed the folder again
        throw_errno("cannot write", part_);
    }
    const int fault = lock_now(fd_, LOCK_EX);
    works_ = fault == 0;
    if (fault == EWOULDBLOCK) {
        ::close(std::exchange(fd_, -1));
        return false;
    }
    if (is_in_place(fd_, part_) && !others_write(folder_, part_, shards)) return true;
    release();
    return false;
}

void ShardLock::release() {
    if (fd_ < 0) return;
    struct stat status {};
    if (::fstat(fd_, &status) == 0 && status.st_size == 0 && is_in_place(fd_, part_)) {
        ::unlink(part_.c_str());
        ::rmdir(part_.parent_path().c_str());  // stays if it holds other files
    }
    ::close(std::exchange(fd_, -1));
}

void ShardLock::remove_parts() const {
    std::error_code ignored;
    fs::remove(part_, ignored);
    remove_journal_parts(folder_);
}

void remove_journal_parts(const fs::path& folder) {
    std::error_code ignored;  // another run may be removing them, or the disk is read-only
    for (const fs::path& part : journal_parts(folder)) {
        if (!is_locked(part)) fs::remove(part, ignored);
    }
    fs::remove(folder / journal_folder_name, ignored);  // stays if it holds other files
}

bool is_written(const fs::path& folder) {
    return std::ranges::any_of(journal_parts(folder), is_locked);
}

}  // namespace sonarsim
