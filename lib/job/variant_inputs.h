#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace sonarsim {

/// InputError if two variants that name the same input files were made from files with other bytes,
/// or by builds whose bytes differ. `folders` are those of the variants; one without a dataset.json
/// counts as not begun. `next`, unless null, is the description of a variant that is not begun yet.
void require_same_inputs(const std::vector<std::filesystem::path>& folders,
                         const nlohmann::ordered_json& next = nullptr);

}  // namespace sonarsim
