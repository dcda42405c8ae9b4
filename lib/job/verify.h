#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sonarsim {

/// What a look at a dataset found.
struct DatasetCheck {
    std::uint64_t files = 0;  ///< looked at
    std::uint64_t bytes = 0;
    std::vector<std::string> faults;     ///< one sentence each, with the cure; none: it is whole
    std::uint64_t more_faults = 0;       ///< that are not told
    std::vector<std::string> strangers;  ///< files that are not the dataset's, relative to it
    bool stopped = false;                ///< ended early on request
};

/// Compares the files of a dataset with SHA256SUMS and with what dataset.json says is there, and
/// opens each of them. Writes nothing. `progress` gets how many files are done and how many there
/// are. InputError when the folder holds no dataset of this version of sonarsim, or a SHA256SUMS
/// that is none; std::system_error when the disk fails.
DatasetCheck verify_dataset(const std::filesystem::path& folder, int threads,
                            const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                            const std::atomic<bool>& stop);

}  // namespace sonarsim
