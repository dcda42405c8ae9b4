#pragma once

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

}  // namespace sonarsim::test
