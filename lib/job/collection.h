#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "job/parallel.h"
#include "mission/dataset_names.h"

namespace sonarsim {

inline constexpr const char* collection_format = "sonarsim collection";
inline constexpr int collection_format_version = 1;

struct CollectionSummary {
    std::uint64_t files = 0;            ///< copied by this run
    std::uint64_t skipped = 0;          ///< there already
    std::vector<std::string> warnings;  ///< datasets that share a seed, a disk without locks
    bool complete = false;
};

/// Collects datasets of different missions, each unchanged in OUT/<mission>/. OUT/collection.json
/// makes their ids unique: instance ids get an offset for each dataset; class ids follow the names,
/// since a name is one class in all datasets. The order of the datasets does not matter.
///
/// InputError when a part is no complete dataset, when one is there twice, when a file differs from
/// its SHA256SUMS, and when `out` holds something else or another run writes there;
/// std::system_error when the disk fails. When `stop` becomes true, the copies under way are
/// finished; the same call resumes later.
CollectionSummary collect_datasets(const std::vector<std::filesystem::path>& parts,
                                   const std::filesystem::path& out, int threads,
                                   const ProgressCallback& progress, const std::atomic<bool>& stop);

/// A collection.json whose keys were checked.
struct CollectionFile {
    nlohmann::ordered_json json;
    bool complete = false;
    std::vector<std::string> folders;  ///< names of the datasets' folders in the collection
};

/// The collection.json of a folder; nothing if it has none. InputError, with the key and what it
/// must be, when it is damaged or names a folder that does not lie in this one directly.
std::optional<CollectionFile> read_collection(const std::filesystem::path& folder);

/// The folders of the datasets in a collection; none if the folder holds no collection. InputError
/// as read_collection().
std::vector<std::filesystem::path> collected_folders(const std::filesystem::path& folder);

/// The errors of a collection besides those of its datasets, a sentence each: its own SHA256SUMS
/// must agree with those of the datasets. Files of the datasets are not read. InputError as
/// read_collection(), and for a damaged SHA256SUMS.
std::vector<std::string> collection_errors(const std::filesystem::path& folder);

}  // namespace sonarsim
