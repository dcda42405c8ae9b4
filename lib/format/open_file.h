#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sonarsim {

struct OpenedFile {
    std::vector<std::size_t> shape;  ///< [height, width] of an image, that of the array of an .npy
    /// Of a grey PNG or an .npy of 16 bits.
    std::optional<std::uint16_t> largest = {};
};

/// Opens a file of a dataset as its reader would: every pixel of a PNG is decoded, the
/// header of an .npy or GeoTIFF file is read and its length compared with it, .npy files of 16 bits
/// are read whole, JSON is parsed; other files are taken as they are. std::runtime_error with the
/// reason when it does not open.
OpenedFile open_file(const std::filesystem::path& path);

/// The same for a file that is in memory and would bear this name: a PNG, .npy or JSON.
OpenedFile open_bytes(const std::string& name, const std::string& bytes);

/// "512 x 256".
std::string shape_text(const std::vector<std::size_t>& shape);

}  // namespace sonarsim
