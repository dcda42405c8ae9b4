#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mission/dataset_names.h"

namespace sonarsim {

inline constexpr const char* collection_format = "sonarsim collection";
inline constexpr int collection_format_version = 1;

/// A collection.json whose keys were checked.
struct CollectionFile {
    nlohmann::ordered_json json;
    bool complete = false;
    std::vector<std::string> folders;  ///< of the datasets, each in that of the collection
};

/// That of a folder; nothing where it has none. InputError, with the key and what it must be, when
/// it is damaged or names a folder that does not lie in this one directly.
std::optional<CollectionFile> read_collection(const std::filesystem::path& folder);

}  // namespace sonarsim
