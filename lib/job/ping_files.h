#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dataset/layout.h"
#include "dataset/record_file.h"
#include "job/journal.h"

namespace sonarsim {

/// One for each sensor and writer; null if the writer writes a file per ping.
using RecordFiles = std::vector<std::vector<std::unique_ptr<RecordFile>>>;

/// Opens the record files of a dataset, or makes them.
RecordFiles open_records(const Layout& layout, RecordAccess access);

/// The output of each writer of a sensor for a ping, in their order: the bytes of a file or record.
using EncodedPing = std::vector<std::string>;

/// The fields of a ping in the journal.
std::string journal_fields(const SensorLayout& sensor, const EncodedPing& encoded);

/// Writes the files and records of a ping where the layout says. From any thread, in any order.
/// std::system_error when the disk does not take it.
void write_ping(const Layout& layout, const RecordFiles& records, const PingId& ping,
                const EncodedPing& encoded);

/// True for the pings that need not be rendered: the journal lists them, and their files and
/// records are as listed. The references must outlive it.
class FinishedPings {
  public:
    FinishedPings(const Layout& layout, const RecordFiles& records)
        : layout_(layout), records_(records), entries_(read_journal(layout.folder)) {}

    bool operator()(const PingId& ping) const;

  private:
    const Layout& layout_;
    const RecordFiles& records_;
    JournalEntries entries_;
};

/// True if all `pings` are finished. Opens no file for writing: the disk may be read-only.
bool has_pings(const Layout& layout, const std::vector<PingId>& pings);

}  // namespace sonarsim
