#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "run/job/parallel.h"

// The commands on folders of datasets that jobs have made or begun.

namespace sonarsim {

struct JobStatus {
    std::string mission;
    std::size_t variants = 0;           ///< 0: a mission without variants
    std::size_t complete_variants = 0;  ///< the dataset itself counts as one
    std::uint64_t pings = 0;            ///< finished; of all datasets that are begun
    std::uint64_t all_pings = 0;        ///< variants that have not begun count as the mean
    bool running = false;  ///< a run holds a lock in one of the folders

    bool complete() const { return complete_variants == std::max<std::size_t>(variants, 1); }
};

/// The progress of a dataset, or of the variants of a mission, in its folder or those of its
/// shards. InputError when a folder holds no dataset, or one of another mission than the first.
JobStatus read_status(const std::vector<std::filesystem::path>& folders);

struct MergeSummary {
    std::uint64_t pings = 0;    ///< copied by this run
    std::uint64_t skipped = 0;  ///< there already
    std::uint64_t missing = 0;  ///< in none of the parts
    bool complete = false;      ///< the result needs no render: a part was complete
    bool stopped = false;       ///< ended early on request
    bool unlocked = false;      ///< the disk has no locks that would refuse a second run
};

/// Copies the pings of shards of one mission, or its variants, into one folder, which holds nothing
/// or an unfinished merge of them; sonarsim render then completes the dataset there. The files that
/// the mission reads are not needed; parts are only read. `progress` counts the datasets.
/// InputError when a part is not a dataset or not of the same mission, inputs, version and build as
/// the first, lacks a file or has a symbolic link in place of one, and when `out` holds something
/// else or another run writes there; std::system_error when the disk fails.
MergeSummary merge_parts(const std::vector<std::filesystem::path>& parts,
                         const std::filesystem::path& out, const ProgressCallback& progress,
                         const std::atomic<bool>& stop);

struct DatasetCheck {
    std::uint64_t files = 0;  ///< number of files that were read
    std::uint64_t bytes = 0;
    std::vector<std::string> errors;         ///< a sentence each, with the cure; empty: all is well
    std::vector<std::string> unknown_files;  ///< files that are not the dataset's, relative to it
    bool stopped = false;                    ///< ended early on request
};

/// Compares the files of a dataset, or of all variants of a mission, with SHA256SUMS and with the
/// list in dataset.json. `progress` counts the files. InputError when the folder holds no dataset
/// of this version of sonarsim, or a damaged SHA256SUMS; std::system_error when the disk fails.
DatasetCheck verify_folder(const std::filesystem::path& folder, int threads,
                           const ProgressCallback& progress, const std::atomic<bool>& stop);

}  // namespace sonarsim
