#pragma once

#include <memory>
#include <vector>

#include "dataset/journal.h"
#include "dataset/layout.h"
#include "dataset/record_file.h"

namespace sonarsim {

/// By sensor and by writer; null where a writer writes a file per ping.
using RecordFiles = std::vector<std::vector<std::unique_ptr<RecordFile>>>;

/// Opens the record files of a dataset, or makes them.
RecordFiles open_records(const Layout& layout, RecordAccess access = RecordAccess::write);

/// Tells which pings need not be rendered: those that the journal lists, and whose files and
/// records are what it says. References must outlive it.
class FinishedPings {
  public:
    FinishedPings(const Layout& layout, const RecordFiles& records);

    bool operator()(const PingId& ping) const;

  private:
    const Layout& layout_;
    const RecordFiles& records_;
    JournalEntries entries_;
};

/// std::runtime_error when the files of records are not those that were opened any more.
void require_records(const RecordFiles& records);

/// std::runtime_error when one of the pings that this run has written is not there any more.
void require_files(const Layout& layout, const std::vector<PingId>& written,
                   const FinishedPings& finished);

/// The sizes of the products by sensor and file. std::runtime_error when one is not there.
ProductSizes require_products(const Layout& layout);

/// Whether every product is there with the size that the journal tells.
bool has_products(const Layout& layout);

}  // namespace sonarsim
