#pragma once

#include <algorithm>
#include <array>
#include <string_view>

// The files and folders of a dataset besides the folders of its sensors (output/dataset/layout.h).
// The names stand here because no sensor may have one of them.

namespace sonarsim {

inline constexpr const char* description_name = "dataset.json";
inline constexpr const char* mission_name = "mission.resolved.yaml";
inline constexpr const char* trajectory_name = "trajectory.tum";
/// The poses that the vehicle's navigation reports.
inline constexpr const char* navigation_name = "navigation.tum";
inline constexpr const char* checksums_name = "SHA256SUMS";
inline constexpr const char* journal_name = "journal.txt";
inline constexpr const char* journal_folder_name = "journal.d";
inline constexpr const char* seabed_folder_name = "seabed";
inline constexpr const char* gallery_name = "index.html";
inline constexpr const char* gallery_folder_name = "index_files";
/// A file in the folder above the datasets of variants.
inline constexpr const char* variants_name = "variants.json";

/// True if the dataset has a file or folder of this name, so that no sensor may have it.
inline bool is_taken_by_dataset(std::string_view name) {
    constexpr std::array<std::string_view, 10> taken{
        description_name, mission_name,        trajectory_name,    checksums_name,
        journal_name,     journal_folder_name, seabed_folder_name, gallery_name,
        navigation_name,  gallery_folder_name};
    return std::ranges::find(taken, name) != taken.end();
}

}  // namespace sonarsim
