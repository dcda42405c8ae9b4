#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

// The label files in the folder above the variants of a mission: COCO files of each sort of
// pictures of all variants and of each part of the split, and statistics.json.

namespace sonarsim {

/// The label files above these variants, which must be complete. `json` is their variants.json.
std::vector<std::string> label_files_of(const nlohmann::ordered_json& json,
                                        std::span<const std::filesystem::path> variants);

/// Writes these files and lists them in SHA256SUMS, after the lines `sums` of the other files
/// in the folder of the variants. Files that agree with SHA256SUMS already stay. Shards that end at
/// once write the same bytes.
void write_label_files(const std::filesystem::path& folder, const nlohmann::ordered_json& json,
                       std::span<const std::filesystem::path> variants, const std::string& sums);

/// Removes all such files.
void remove_label_files(const std::filesystem::path& folder);

}  // namespace sonarsim
