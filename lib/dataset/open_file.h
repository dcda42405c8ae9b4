#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace sonarsim {

/// Opens a file of a dataset as its reader would: every pixel of a PNG or TIFF is decoded, the
/// header of an .npy file is read and its length compared with it, JSON is parsed; other files are
/// taken as they are. Returns the shape: [height, width] of an image, that of the array of an .npy,
/// nothing of the others. std::runtime_error with the reason when it does not open.
std::vector<std::size_t> open_file(const std::filesystem::path& path);

/// The same for a file that is in memory and would bear this name: a PNG, .npy or JSON.
std::vector<std::size_t> open_bytes(const std::string& name, const std::string& bytes);

/// "512 x 256".
std::string shape_text(const std::vector<std::size_t>& shape);

}  // namespace sonarsim
