#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sonarsim {

/// The format of the data of a NumPy file.
struct NpyFormat {
    std::string type;                ///< "|u1", "<u2", "<f4", "<f8"; the digit is the size in bytes
    std::vector<std::size_t> shape;  ///< two dimensions or more
    bool fortran_order = false;      ///< the first index varies fastest
};

/// The header of a NumPy file, format 1.0. Its length is a multiple of 64 bytes.
std::string npy_header(const NpyFormat& format);

/// A float32 matrix as a NumPy file, format 1.0, little endian, C order.
std::string npy_bytes(std::span<const float> values, std::size_t rows, std::size_t columns);

}  // namespace sonarsim
