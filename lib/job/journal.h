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

#include "job/told_pings.h"

namespace sonarsim {

/// Bytes, by sensor and file.
using ProductSizes = std::map<std::pair<std::uint32_t, std::string>, std::uint64_t>;

/// What a dataset holds, as its journal tells: a ping stands in it once all of its files are
/// durable. A text, one line each:
///
///     ping SENSOR POSE WHAT...  of each of the sensor's writers SIZE:SHA256 of the ping's file,
///                               size in bytes, or the hash of its record
///     product SENSOR FILE SIZE  in the finished dataset; of all sensors together where SENSOR is
///                               their number
///     run SECONDS               in a part: a run began to write here, seconds since 1970
///     checkpoint SECONDS        in a part: the lines before it became durable then
///
/// SENSOR is the index in dataset.json, POSE that of the pose. Each line ends in a hash of what
/// stands before it, so that a line that a power cut tore does not count.
struct JournalEntries {
    ToldPings pings;
    ProductSizes products;
};

/// Reads OUT/journal.txt and all parts in OUT/journal.d/ (those of shards that ran in other
/// folders are copied there when these are merged). Lines that are torn are left out.
JournalEntries read_journal(const std::filesystem::path& folder);

/// What the last run that wrote to a part of the journal has done.
struct JournalRun {
    std::uint64_t pings = 0;
    double first_s = 0.0;  ///< when it opened the part, since 1970; 0: unknown
    double last_s = 0.0;   ///< when it made its last checkpoint
};
JournalRun read_journal_run(const std::filesystem::path& part);

/// Writes OUT/journal.txt: the same for all ways in which a dataset may have come about.
void write_journal(const std::filesystem::path& path, const JournalEntries& entries);

/// The part of the journal that one run writes. A background thread makes a checkpoint every few
/// seconds: it makes durable what has been written so far and then adds the lines of the pings that
/// were finished before. So a power cut costs the pings since the last checkpoint and nothing else.
/// The part is locked as long as the run writes it: no other run can write it, and `status` can
/// tell.
class Journal {
  public:
    /// Adds to OUT/journal.d/`name`. InputError when another run writes it; std::system_error when
    /// the disk does not allow it.
    Journal(const std::filesystem::path& folder, const std::string& name,
            double checkpoint_seconds);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Every file of the ping has its final name. Throws what a checkpoint has failed with.
    void add(const PingId& ping, const std::vector<std::string>& what);
    /// The last checkpoint. Throws what a checkpoint has failed with.
    void finish();

    /// False where the file system has no locks.
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
    double start_s_;       ///< of the run, since 1970; 0 once the part says so
    bool ending_ = false;
    std::exception_ptr fault_;
    std::thread thread_;  ///< last, so that it starts when the rest is there
};

}  // namespace sonarsim
