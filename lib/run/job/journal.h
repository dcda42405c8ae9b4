#pragma once

#include <condition_variable>
#include <filesystem>
#include <future>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "output/dataset/writer.h"
#include "run/job/shard_lock.h"

namespace sonarsim {

/// The pings of a dataset whose files are all durable. The journal has a line for each:
///
///     ping SENSOR POSE FIELD... one field for each of the sensor's writers: SIZE:SHA256 of the
///                               ping's file, size in bytes, or the hash of its record
///
/// SENSOR is the index in dataset.json, POSE that of the pose. Each line ends in a hash of the text
/// before it, so that a line that a power cut tore does not count.
using JournalEntries = std::map<PingId, std::string>;  ///< the fields with a blank between them

/// Reads OUT/journal.txt and all of OUT/journal.d/ but torn lines. InputError for unreadable parts.
JournalEntries read_journal(const std::filesystem::path& folder);

/// Writes OUT/journal.txt: its bytes do not depend on the runs that made the dataset.
void write_journal(const std::filesystem::path& path, const JournalEntries& entries);

/// The part of the journal that one run writes. Every few seconds a background thread makes files
/// durable and then adds the lines of their pings: a power cut costs only the pings since then.
class Journal {
  public:
    /// Adds to the part of `lock`, which must outlive it.
    Journal(const ShardLock& lock, double checkpoint_seconds);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Call it once every file of the ping has its final name. Throws the error of a checkpoint.
    void add(const PingId& ping, const std::string& fields);
    /// Makes the last checkpoint. Throws the error of a checkpoint.
    void finish();

  private:
    void make_checkpoints(double seconds_between);
    void append(std::string_view lines) const;

    const ShardLock& lock_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::string pending_;  ///< lines of pings that are not durable yet
    bool ending_ = false;
    std::future<void> checkpoints_;  ///< last, so that its thread starts when the rest is there
};

}  // namespace sonarsim
