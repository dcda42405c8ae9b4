#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace sonarsim {

/// Removes the files that a dataset consists of by its dataset.json (`description`), whole or not,
/// their gallery, and the folders that are empty then. Other files stay, and so does all that is
/// reached through a symbolic link. Whatever the description says, nothing outside `folder` is
/// touched. InputError, and nothing is removed, when it lists one of `inputs`, which the mission
/// reads.
void remove_listed_files(const std::filesystem::path& folder,
                         const nlohmann::ordered_json& description,
                         const std::vector<std::filesystem::path>& inputs);

}  // namespace sonarsim
