#pragma once

#include <memory>
#include <vector>

#include "dataset/layout.h"
#include "dataset/record_file.h"
#include "job/journal.h"

namespace sonarsim {

/// One for each sensor and writer; null if the writer writes a file per ping.
using RecordFiles = std::vector<std::vector<std::unique_ptr<RecordFile>>>;

/// Opens the record files of a dataset, or makes them. Few files stay open; `datasets` is the
/// number of datasets in use at the same time.
RecordFiles open_records(const Layout& layout, RecordAccess access = RecordAccess::write,
                         std::size_t datasets = 1);

/// True for the pings that need not be rendered: the journal lists them, and their files and
/// records are as listed. The references must outlive it.
class FinishedPings {
  public:
    FinishedPings(const Layout& layout, const RecordFiles& records);

    bool operator()(const PingId& ping) const;

    /// The fields of a finished ping in the journal.
    std::vector<std::string> fields_of(const PingId& ping) const;

  private:
    const Layout& layout_;
    const RecordFiles& records_;
    JournalEntries entries_;
};

/// std::runtime_error when a file of records was removed or replaced after it was opened.
void require_records(const RecordFiles& records);

/// std::runtime_error when a ping that this run has written is not there any more.
void require_files(const Layout& layout, const std::vector<PingId>& written,
                   const FinishedPings& finished);

/// The sizes of the products by sensor and file. std::runtime_error when one is not there.
ProductSizes require_products(const Layout& layout);

/// True if a dataset whose dataset.json says `complete` has `pings` and all products. Opens no file
/// for writing: the disk may be read-only.
bool has_all(const Layout& layout, const std::vector<PingId>& pings);

}  // namespace sonarsim
