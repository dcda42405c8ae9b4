#pragma once

#include <cstdint>
#include <istream>

namespace sonarsim {

struct ExrShape {
    std::size_t rows = 0;
    std::size_t columns = 0;
};

/// The shape of an OpenEXR file of one part in uncompressed rows. Reads the header, and checks that
/// the last row ends at the end of the file, which has `bytes` bytes. std::runtime_error for
/// another file.
ExrShape exr_shape(std::istream& file, std::uint64_t bytes);

}  // namespace sonarsim
