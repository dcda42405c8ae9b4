#pragma once

#include <filesystem>
#include <string_view>

#include "mission/dataset_names.h"

namespace sonarsim {

// The page that `sonarsim gallery` puts beside the files of a dataset. It is no part of the
// dataset: dataset.json and SHA256SUMS do not list it, and whoever replaces the dataset removes it.

/// Stands in every such page, and tells it from others.
inline constexpr std::string_view gallery_mark =
    R"(<meta name="generator" content="sonarsim gallery">)";

/// Whether the folder holds an index.html that is a gallery. No link is followed.
bool has_gallery(const std::filesystem::path& folder);

}  // namespace sonarsim
