#pragma once

#include <cstdint>
#include <filesystem>

namespace sonarsim {

struct GallerySummary {
    std::filesystem::path file;
    std::uint64_t bytes = 0;
    std::uint64_t pings = 0;  ///< all datasets together
    std::uint64_t datasets = 0;
};

/// Writes FOLDER/index.html, a page that shows the pictures of a dataset ping by ping, its
/// trajectory, metadata and labels; of a folder with variants or of a collection, those of each
/// dataset in it. It is one file without a network: pictures are loaded by their paths from the
/// folder, all else is in the page. It replaces a page of its own; the datasets, and what verifies
/// them, do not change. InputError when a dataset is damaged or of another version, or the folder
/// holds no dataset, or an index.html of somebody else; std::system_error when the disk fails.
GallerySummary write_gallery(const std::filesystem::path& folder);

}  // namespace sonarsim
