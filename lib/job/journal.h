#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "job/ping_index.h"

namespace sonarsim {

/// Bytes, by sensor and file.
using ProductSizes = std::map<std::pair<std::uint32_t, std::string>, std::uint64_t>;

/// The content of a dataset by its journal. A ping is in the journal once all of its files are
/// durable. The journal is a text with one entry a line:
///
///     ping SENSOR POSE FIELD... one field for each of the sensor's writers: SIZE:SHA256 of the
///                               ping's file, size in bytes, or the hash of its record
///     product SENSOR FILE SIZE  in the finished dataset; SENSOR is the number of sensors if the
///                               product is made of all of them
///     run SECONDS               in a part: a run began to write here, seconds since 1970
///     checkpoint SECONDS        in a part: the lines before it became durable then
///
/// SENSOR is the index in dataset.json, POSE that of the pose. Each line ends in a hash of the text
/// before it, so that a line that a power cut tore does not count.
struct JournalEntries {
    PingIndex pings;
    ProductSizes products;
};

/// Reads OUT/journal.txt and all parts in OUT/journal.d/ (those of shards that ran in other
/// folders are copied there when these are merged). Torn lines are left out. InputError when a part
/// cannot be read.
JournalEntries read_journal(const std::filesystem::path& folder);

/// The last run that wrote to a part of the journal.
struct JournalRun {
    std::uint64_t pings = 0;
    double first_s = 0.0;  ///< time at which it opened the part, since 1970; 0: unknown
    double last_s = 0.0;   ///< time of its last checkpoint
};
JournalRun read_journal_run(const std::filesystem::path& part);

/// Writes OUT/journal.txt: its bytes do not depend on the runs that made the dataset.
void write_journal(const std::filesystem::path& path, const JournalEntries& entries);

double seconds_since_1970();

/// The part of the journal that one run writes. A background thread makes a checkpoint every few
/// seconds: it makes durable what has been written so far and then adds the lines of the pings that
/// were finished before. A power cut costs only the pings since the last checkpoint. The run holds
/// a lock on the part: no other run can write it, and `status` sees that it is running.
class Journal {
  public:
    /// Adds to OUT/journal.d/`name`. InputError when another run writes it; std::system_error when
    /// the disk does not allow it.
    Journal(const std::filesystem::path& folder, const std::string& name,
            double checkpoint_seconds);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Call it once every file of the ping has its final name. Throws the error of a checkpoint.
    void add(const PingId& ping, const std::vector<std::string>& fields);
    /// Makes the last checkpoint. Throws the error of a checkpoint.
    void finish();

    /// False if the file system has no locks.
    bool lock_works() const { return lock_works_; }

  private:
    void run(double checkpoint_seconds);
    void checkpoint();
    void rethrow();

    std::filesystem::path folder_;
    std::filesystem::path path_;
    int fd_;
    bool lock_works_ = true;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::string pending_;  ///< lines of pings that are not durable yet
    double start_s_;       ///< begin of the run, since 1970; 0 once the part has it
    bool ending_ = false;
    std::exception_ptr error_;
    std::thread thread_;  ///< last, so that it starts when the rest is there
};

}  // namespace sonarsim
