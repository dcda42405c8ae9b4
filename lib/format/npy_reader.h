#pragma once

#include <cstddef>
#include <string_view>

#include "format/npy.h"

namespace sonarsim {

/// A NumPy file of any program in memory. `data` has the length that the format says.
struct NpyView {
    NpyFormat format;
    std::string_view data;
    std::size_t values = 0;
};

/// Reads the formats 1.0 to 3.0 with one to four dimensions of uint8, uint16, float32 or float64,
/// little-endian, in either order. Throws std::runtime_error with the reason for any other file.
/// `bytes` must outlive the view.
NpyView read_npy(std::string_view bytes);

/// The value with the number `k` in C order, the last index first.
double npy_value(const NpyView& array, std::size_t k);

}  // namespace sonarsim
