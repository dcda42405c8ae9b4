#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace sonarsim {

/// Tags of the first image of a TIFF file, by their number.
struct TiffTags {
    bool is_big_endian = false;
    std::map<std::uint16_t, std::vector<double>> numbers;
    std::map<std::uint16_t, std::string> texts;
    /// The place in the file of the first value of a tag.
    std::map<std::uint16_t, std::uint64_t> places;
};

/// True if a file begins like a TIFF or a BigTIFF.
bool is_tiff(const std::filesystem::path& path);

/// Reads those of the `wanted` tags that the file has. InputError if the list of tags, or one of
/// these, reaches beyond the end of the file.
TiffTags read_tiff_tags(const std::filesystem::path& path, const std::set<std::uint16_t>& wanted);

/// True if the file holds a mask of its pixels, as GDAL writes it where pixels are unknown.
/// InputError if a list of tags reaches beyond the end of the file.
bool has_tiff_mask(const std::filesystem::path& path);

}  // namespace sonarsim
