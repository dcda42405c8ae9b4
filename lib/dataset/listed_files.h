#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace sonarsim {

/// Removes the files that a dataset consists of by its dataset.json (`description`), whole or not,
/// and the folders that are empty then. Other files stay, and so does all that is reached through a
/// symbolic link. Whatever the description says, nothing outside `folder` is touched.
void remove_listed_files(const std::filesystem::path& folder,
                         const nlohmann::ordered_json& description);

}  // namespace sonarsim
