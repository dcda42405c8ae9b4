#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sonarsim {

struct OpenedFile {
    std::vector<std::size_t> shape;  ///< [height, width] of an image, or the shape of an array
    /// The largest value of a grey PNG or an array of 16 bits.
    std::optional<std::uint16_t> largest = {};
};

/// Opens a file of a dataset as a reader would. It decodes every pixel of a PNG, compares the size
/// of an .npy, TIFF or OpenEXR file with its header, reads .npy files of 16 bits whole, and parses
/// JSON; other files are not read. Throws std::runtime_error with the reason when the file does not
/// open.
OpenedFile open_file(const std::filesystem::path& path);

/// The same for a file in memory that has this name.
OpenedFile open_bytes(const std::string& name, const std::string& bytes);

/// A shape as text, "512 x 256".
std::string shape_text(const std::vector<std::size_t>& shape);

}  // namespace sonarsim
