#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "job/parallel.h"

namespace sonarsim {

struct MergeSummary {
    std::uint64_t pings = 0;    ///< copied by this run
    std::uint64_t skipped = 0;  ///< there already
    bool complete = false;
    bool unlocked = false;  ///< the disk has no locks that would refuse a second run
};

/// Joins datasets of one mission whose pings were rendered into several folders (shards of several
/// machines, or interrupted runs) into `out`, which holds nothing or an unfinished merge of them.
/// The result has the bytes of a single run; the files that the mission reads are not needed. Parts
/// are only read. Every file is compared with the sum in its part's journal.
///
/// InputError when a part is no dataset or not of the same mission, inputs, version and build as
/// the first, when a ping is in none of them, when a file is not what its journal says, and when
/// `out` holds something else or another run writes there; std::system_error when the disk fails.
/// When `stop` becomes true, the copies under way are finished and the rest is left for a later
/// run.
MergeSummary merge_datasets(const std::vector<std::filesystem::path>& parts,
                            const std::filesystem::path& out, int threads,
                            const ProgressCallback& progress, const std::atomic<bool>& stop);

/// InputError when `out` is one of the parts.
void require_apart(const std::vector<std::filesystem::path>& parts,
                   const std::filesystem::path& out);

}  // namespace sonarsim
