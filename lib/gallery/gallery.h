#pragma once

#include <cstdint>
#include <filesystem>

namespace sonarsim {

struct GallerySummary {
    std::filesystem::path file;
    std::uint64_t bytes = 0;
    std::uint64_t pings = 0;
};

/// Writes DATASET/index.html, a page that shows the pictures of the dataset ping by ping, its
/// trajectory, metadata and labels. It is one file without a network: pictures are loaded by their
/// paths from the folder, all else is in the page. It replaces a page of its own; the dataset, and
/// what verifies it, do not change. InputError when the folder is no dataset of this version, or
/// holds an index.html of somebody else; std::system_error when the disk fails.
GallerySummary write_gallery(const std::filesystem::path& folder);

}  // namespace sonarsim
