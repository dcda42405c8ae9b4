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
/// trajectory, metadata and labels; for a folder with variants or a collection, those of each
/// dataset in it. The page needs no network: it loads pictures by their paths from the folder and
/// holds all else. It replaces an older page of sonarsim; the datasets and their checksums do not
/// change. InputError when a dataset is damaged or of another version, when the folder holds no
/// dataset, or an index.html of another origin; std::system_error when the disk fails.
GallerySummary write_gallery(const std::filesystem::path& folder);

}  // namespace sonarsim
