#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sonarsim {

struct CollectionSummary {
    std::uint64_t files = 0;            ///< copied by this run
    std::uint64_t skipped = 0;          ///< there already
    std::vector<std::string> warnings;  ///< of datasets that share a seed, of a disk without locks
    bool complete = false;
};

/// Puts datasets of different missions side by side, each whole and unchanged in OUT/<mission>/,
/// and tells in OUT/collection.json how their ids are kept apart: those of instances by an offset
/// for each dataset, those of classes by their names, which are the same class in all of them. The
/// order of the datasets does not matter.
///
/// InputError when a part is no complete dataset, when one is there twice, when a file is not what
/// its SHA256SUMS says, and when `out` holds something else or another run writes there;
/// std::system_error when the disk fails. When `stop` becomes true, the copies under way are
/// finished; the same call goes on later.
CollectionSummary collect_datasets(
    const std::vector<std::filesystem::path>& parts, const std::filesystem::path& out, int threads,
    const std::function<void(std::uint64_t, std::uint64_t)>& progress,
    const std::atomic<bool>& stop);

/// The folders of the datasets in a collection; none when the folder holds no collection.
/// InputError when its collection.json is damaged.
std::vector<std::filesystem::path> collected_folders(const std::filesystem::path& folder);

/// What is wrong with a collection besides its datasets, a sentence each: whether its own
/// SHA256SUMS tells what those of the datasets do. Their files are not read. InputError as above,
/// and for sums that are none.
std::vector<std::string> collection_faults(const std::filesystem::path& folder);

}  // namespace sonarsim
