#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sonarsim {

/// A matrix, row by row.
struct Matrix {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<float> values;  ///< [rows, columns]
};

/// A float32 matrix as a NumPy file, format 1.0, little endian, C order; the data begin at a
/// multiple of 64 bytes.
std::string npy_bytes(std::span<const float> values, std::size_t rows, std::size_t columns);

/// Reads back what npy_bytes() writes; InputError for any other file.
Matrix read_npy(const std::filesystem::path& path);

}  // namespace sonarsim
