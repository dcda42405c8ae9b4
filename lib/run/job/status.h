#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sonarsim {

/// The progress of a job.
struct JobStatus {
    std::string mission;
    std::size_t variants = 0;           ///< 0: a mission without variants
    std::size_t complete_variants = 0;  ///< the dataset itself counts as one
    std::uint64_t pings = 0;            ///< finished; of all datasets that are begun
    std::uint64_t all_pings = 0;
    bool running = false;  ///< a run holds a lock in one of the folders

    bool complete() const { return complete_variants == std::max<std::size_t>(variants, 1); }
};

/// Reads the progress of a dataset, or of the variants of a mission, from its folder, or from the
/// folders with its shards. InputError when a folder holds no dataset, or one of another mission
/// than the first.
JobStatus read_status(const std::vector<std::filesystem::path>& folders);

}  // namespace sonarsim
