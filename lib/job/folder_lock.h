#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>

#include "checks/warning.h"

namespace sonarsim {

/// The right to write into a folder. It is a lock (flock) on the folder itself: it leaves no file,
/// and it ends with the process, however that ends. A run that writes a whole dataset holds the
/// folder alone; shards of one job share it. If the file system has no locks, every lock is
/// granted.
///
/// On a network file system the lock of a folder holds on one machine only. The lock of a part of
/// the journal, which is a file, holds on all machines; others_write() checks these locks.
class FolderLock {
  public:
    /// Returns true to keep waiting for another run; called every few hundredths of a second.
    using Waits = std::function<bool()>;

    /// Makes the folder where there is none. Locks nothing yet. InputError when the path is no
    /// folder; std::system_error when the disk refuses.
    explicit FolderLock(std::filesystem::path folder);
    ~FolderLock();
    FolderLock(FolderLock&& other) noexcept;
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

    // Each replaces the lock held before; in between another run may take the folder. Returns
    // false, and holds no lock, when another run holds the folder and `waits` returns false.
    bool take_alone(const Waits& waits);
    bool share(const Waits& waits);
    /// Takes the folder alone if no other run is at work, else shares it.
    bool take_alone_or_share(const Waits& waits);

    /// False if the file system has no locks.
    bool works() const { return works_; }

  private:
    bool take(std::initializer_list<int> modes, const Waits& waits);
    bool try_lock(int mode);
    bool is_in_place() const;
    void open();
    void close();

    std::filesystem::path folder_;
    int fd_ = -1;
    bool works_ = true;
};

/// Locks a folder for one run alone. InputError when another run writes there.
FolderLock lock_alone(const std::filesystem::path& folder);

/// Locks the folder of a dataset for a run: alone, or with the other shards of its division. A
/// shard waits while another one is alone there, to set the folder up or to complete the dataset;
/// nothing is returned when `stop` becomes true meanwhile. InputError when another run writes
/// there.
std::optional<FolderLock> lock_for_run(const std::filesystem::path& folder, int shards,
                                       const std::atomic<bool>& stop);

/// InputError: another run writes into the folder.
[[noreturn]] void refuse_second_run(const std::filesystem::path& folder);

/// W28: the file system has no locks.
Warning no_locks_warning(const std::filesystem::path& folder);

/// Locks a file for this process alone. Returns false when another process has locked it for longer
/// than is_locked() does; `works` becomes false if the file system has no locks.
bool lock_file(int fd, bool& works);

/// True if a process has locked a file with lock_file().
bool is_locked(const std::filesystem::path& file);

/// True if a run that is not a shard of the same division in `shards` writes into the folder of a
/// dataset, by the locks on the parts of the journal. A run that is no shard has no division.
bool others_write(const std::filesystem::path& folder, int shards);

}  // namespace sonarsim
