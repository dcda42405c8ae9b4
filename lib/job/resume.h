#pragma once

#include <memory>
#include <vector>

#include "dataset/layout.h"
#include "dataset/record_file.h"
#include "job/journal.h"

namespace sonarsim {

/// By sensor and by writer; null where a writer writes a file per ping.
using RecordFiles = std::vector<std::vector<std::unique_ptr<RecordFile>>>;

/// Opens the record files of a dataset, or makes them. Few of them stay open, however many there
/// are: `datasets` are used at the same time.
RecordFiles open_records(const Layout& layout, RecordAccess access = RecordAccess::write,
                         std::size_t datasets = 1);

/// Tells which pings need not be rendered: those that the journal lists, and whose files and
/// records are what it says; in a pack, only as long as no ping before them is missing. References
/// must outlive it.
class FinishedPings {
  public:
    FinishedPings(const Layout& layout, const RecordFiles& records);

    bool operator()(const PingId& ping) const;

    /// Where a ping's files begin in its pack; those before it are finished.
    std::uint64_t begin_in_pack(const PingId& ping) const;
    /// Of a finished ping the bytes of its k-th file.
    std::uint64_t bytes_of(const PingId& ping, std::size_t k) const;
    /// What the journal says of a finished ping.
    std::vector<std::string> words_of(const PingId& ping) const;

  private:
    bool is_told(const PingId& ping) const;
    void find_packed(std::uint32_t sensor);

    const Layout& layout_;
    const RecordFiles& records_;
    JournalEntries entries_;
    /// Of sensors with packs by ping: where its files end in its pack; 0: it is not finished.
    std::vector<std::vector<std::uint64_t>> ends_;
};

/// std::runtime_error when the files of records are not those that were opened any more.
void require_records(const RecordFiles& records);

/// std::runtime_error when one of the pings that this run has written is not there any more.
void require_files(const Layout& layout, const std::vector<PingId>& written,
                   const FinishedPings& finished);

/// The sizes of the products by sensor and file. std::runtime_error when one is not there.
ProductSizes require_products(const Layout& layout);

/// Whether a dataset that says that it is complete has `pings` and all that is made of them. Opens
/// nothing to write, so that the disk may be read-only.
bool has_all(const Layout& layout, const std::vector<PingId>& pings);

}  // namespace sonarsim
