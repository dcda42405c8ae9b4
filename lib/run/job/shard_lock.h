#pragma once

#include <filesystem>

namespace sonarsim {

/// The right of a shard to write into a folder: a lock (flock) on its part of the journal. It ends
/// with the process, however that ends. The shards of one division write at the same time; any
/// other two runs exclude each other. If the file system has no locks, every lock is granted.
class ShardLock {
  public:
    /// Makes the folder and the part; a whole run is shard 0 of 1. InputError when another run
    /// writes there, or there cannot be such a folder; std::system_error when the disk refuses.
    ShardLock(const std::filesystem::path& folder, int shard, int shards);
    /// Removes the part if it is still empty.
    ~ShardLock();
    ShardLock(const ShardLock&) = delete;
    ShardLock& operator=(const ShardLock&) = delete;

    /// Removes this part and those that no run holds, once journal.txt has their lines.
    void remove_parts() const;
    /// False if the file system has no locks.
    bool works() const { return works_; }
    /// The folder, and the part of its journal, open for appending.
    const std::filesystem::path& folder() const { return folder_; }
    const std::filesystem::path& part() const { return part_; }
    int fd() const { return fd_; }

  private:
    bool take(int shards);
    void release();

    std::filesystem::path folder_;
    std::filesystem::path part_;
    int fd_ = -1;
    bool works_ = true;
};

/// Removes the parts of the journal that no run holds, once journal.txt has their lines.
void remove_journal_parts(const std::filesystem::path& folder);

/// True if a run writes into the folder.
bool is_written(const std::filesystem::path& folder);

}  // namespace sonarsim
