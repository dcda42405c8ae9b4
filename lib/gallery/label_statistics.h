#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace sonarsim {

/// The statistics.json of a folder as the scripts of the page take it: the tally of all pictures,
/// those of each COCO file, and the warnings about the classes. Null if there is none. InputError
/// when the file is damaged.
nlohmann::ordered_json label_statistics(const std::filesystem::path& folder);

/// The axes of its histograms: key, title, edges.
nlohmann::ordered_json statistics_axes_json();

}  // namespace sonarsim
