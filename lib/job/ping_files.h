#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "dataset/layout.h"
#include "job/pack_file.h"
#include "job/resume.h"

namespace sonarsim {

/// What each writer of its sensor made of a ping, in their order: the bytes of a file or a record.
using EncodedPing = std::vector<std::string>;

/// What the journal says of them.
std::vector<std::string> journal_words(const SensorLayout& sensor, const EncodedPing& encoded);

/// A ping that is in a dataset. `finished` is that of the dataset. InputError when a file cannot be
/// read; std::system_error when the disk fails.
EncodedPing read_ping(const Layout& layout, const RecordFiles& records,
                      const FinishedPings& finished, const PingId& ping);

/// Puts what writers made of pings where the layout says. References must outlive it.
class PingFiles {
  public:
    /// `there`: what the dataset held when the run began.
    PingFiles(const Layout& layout, const RecordFiles& records, const FinishedPings& there);

    /// What has a place of its own: loose files and records. From any thread, in any order.
    /// std::system_error when the disk does not take it.
    void write(const PingId& ping, const EncodedPing& encoded) const;
    /// What goes into packs: from one thread at a time, and of each sensor in the order of its
    /// pings. std::system_error as above.
    void pack(const PingId& ping, const EncodedPing& encoded);

  private:
    /// The pack of a sensor that is being filled.
    struct Filling {
        std::size_t number = 0;
        std::uint64_t end = 0;  ///< of what is in it
        std::unique_ptr<PackFile> file;
    };

    const Layout& layout_;
    const RecordFiles& records_;
    const FinishedPings& there_;
    std::vector<Filling> filling_;  ///< by sensor
    bool keep_open_;                ///< packs between two pings
};

}  // namespace sonarsim
