#pragma once

#include <filesystem>

namespace sonarsim {

/// InputError for a TIFF that OpenImageIO 2.4 would read wrongly without an error: one whose pixels
/// end before the file says or were never written, tiles of 64-bit numbers (read as zeros), and the
/// floating-point predictor of a big-endian file (bytes in a wrong order).
void require_whole_tiff(const std::filesystem::path& path);

}  // namespace sonarsim
