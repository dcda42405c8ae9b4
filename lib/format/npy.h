#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sonarsim {

/// A matrix, row by row.
struct Matrix {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<float> values;  ///< [rows, columns]
};

/// What the data of a NumPy file are.
struct NpyFormat {
    std::string type;                ///< "|u1", "<u2", "<f4", "<f8": its last digit is its bytes
    std::vector<std::size_t> shape;  ///< two dimensions or more
    bool fortran_order = false;      ///< the first index runs fastest
};

/// What stands before the data, format 1.0; its length is a multiple of 64 bytes.
std::string npy_header(const NpyFormat& format);

/// The format that a file with this beginning has. std::runtime_error when that is not what
/// npy_header() writes.
NpyFormat npy_format(std::string_view start);

/// A float32 matrix as a NumPy file, format 1.0, little endian, C order; the data begin at a
/// multiple of 64 bytes.
std::string npy_bytes(std::span<const float> values, std::size_t rows, std::size_t columns);

/// The same of what is stored column after column.
std::string npy_bytes_of_columns(std::span<const float> by_column, std::size_t rows,
                                 std::size_t columns);

/// Reads back what npy_bytes() writes; InputError for any other file.
Matrix read_npy(const std::filesystem::path& path);

}  // namespace sonarsim
