#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "run/job/parallel.h"

namespace sonarsim {

/// The result of verify_folder().
struct DatasetCheck {
    std::uint64_t files = 0;  ///< number of files that were read
    std::uint64_t bytes = 0;
    std::vector<std::string> errors;         ///< a sentence each, with the cure; empty: all is well
    std::vector<std::string> unknown_files;  ///< files that are not the dataset's, relative to it
    bool stopped = false;                    ///< ended early on request
};

/// Compares the files of a dataset, or of all variants of a mission, with SHA256SUMS and with the
/// list in dataset.json. Writes nothing. `progress` gets the number of files that are done and of
/// all files. InputError when the folder holds no dataset of this version of sonarsim, or a damaged
/// SHA256SUMS; std::system_error when the disk fails.
DatasetCheck verify_folder(const std::filesystem::path& folder, int threads,
                           const ProgressCallback& progress, const std::atomic<bool>& stop);

}  // namespace sonarsim
