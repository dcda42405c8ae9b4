#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "run/job/parallel.h"

namespace sonarsim {

struct MergeSummary {
    std::uint64_t pings = 0;    ///< copied by this run
    std::uint64_t skipped = 0;  ///< there already
    std::uint64_t missing = 0;  ///< in none of the parts
    bool complete = false;      ///< the result needs no render: a part was complete
    bool stopped = false;       ///< ended early on request
    bool unlocked = false;      ///< the disk has no locks that would refuse a second run
};

/// Copies the pings of shards of one mission, or its variants, into one folder, which holds nothing
/// or an unfinished merge of them. sonarsim render then renders there what is missing, and
/// completes the dataset. The files that the mission reads are not needed; parts are only read.
/// `progress` counts the datasets.
///
/// InputError when a part is not a dataset or not of the same mission, inputs, version and build as
/// the first, lacks a file or has a symbolic link in place of one, and when `out` holds something
/// else or another run writes there; std::system_error when the disk fails.
MergeSummary merge_parts(const std::vector<std::filesystem::path>& parts,
                         const std::filesystem::path& out, const ProgressCallback& progress,
                         const std::atomic<bool>& stop);

}  // namespace sonarsim
