#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "output/dataset/layout.h"
#include "output/dataset/record_file.h"
#include "output/dataset/writer.h"
#include "run/job/journal.h"
#include "run/job/render_summary.h"

namespace sonarsim {

/// One for each sensor and writer; null if the writer writes a file per ping.
using RecordFiles = std::vector<std::vector<std::unique_ptr<RecordFile>>>;

/// Opens the record files of a dataset, or makes them.
RecordFiles open_records(const Layout& layout, RecordAccess access);

/// Writes the files and records of a ping where the layout says; `encoded` has the bytes of each
/// writer. Returns the fields of the ping in the journal. From any thread, in any order.
/// std::system_error when the disk does not take it.
std::string write_ping(const Layout& layout, const RecordFiles& records, const PingId& ping,
                       const std::vector<std::string>& encoded);

/// The pings that need not be rendered: the journal lists them, and their files and records are as
/// listed. Opens no file for writing: the disk may be read-only. The layout must outlive it.
class FinishedPings {
  public:
    explicit FinishedPings(const Layout& layout);

    bool has_all(const std::vector<PingId>& pings) const;
    std::vector<PingId> missing(std::vector<PingId> pings) const;

  private:
    bool has(const PingId& ping) const;

    const Layout& layout_;
    RecordFiles records_;
    JournalEntries entries_;
};

/// A run as its steps share it.
struct RenderRun {
    const Mission& mission;
    const Assembly& assembly;
    const JobCallback& progress;
    const std::atomic<bool>& stop;
    int threads;
    RenderSummary& summary;
};

/// The place that a run writes to.
struct Destination {
    const Layout& layout;
    const std::vector<Writers>& writers;
    const RecordFiles& records;
    Journal& journal;
};

/// Renders `todo`, several pings at a time. Without a destination nothing is written, but labels
/// are found.
void render_pings(const RenderRun& run, const VisibilityEngine& engine,
                  const std::vector<PingId>& todo, const Destination* to);

}  // namespace sonarsim
