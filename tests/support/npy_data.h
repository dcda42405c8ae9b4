#pragma once

#include <cstdio>

#include "output/format/npy.h"
#include "support/test.h"

namespace sonarsim::test {

/// The data after the header of a NumPy file. Requires the header of `format`.
template <class T>
std::vector<T> data_of(const std::filesystem::path& path, const NpyFormat& format) {
    const std::string bytes = read_file(path, 1 << 26);
    const std::string header = npy_header(format);
    REQUIRE(bytes.starts_with(header));
    std::vector<T> values((bytes.size() - header.size()) / sizeof(T));
    std::memcpy(values.data(), bytes.data() + header.size(), values.size() * sizeof(T));
    return values;
}

/// A matrix, row by row.
struct Matrix {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<float> values;  ///< [rows, columns]
};

/// Reads a file of npy_bytes().
inline Matrix read_npy(const std::filesystem::path& path) {
    const std::string text = read_file(path, 1 << 26);
    const std::size_t at = text.find("'shape'");
    REQUIRE(at != std::string::npos);
    Matrix matrix;
    REQUIRE(std::sscanf(text.c_str() + at, "'shape': (%zu, %zu)", &matrix.rows, &matrix.columns) ==
            2);
    matrix.values = data_of<float>(path, {"<f4", {matrix.rows, matrix.columns}});
    return matrix;
}

}  // namespace sonarsim::test
