#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/images/image.h"

namespace sonarsim {

/// The facts that undo OpenImageIO's changes to a file's numbers: it scales numbers of fewer bits
/// than a byte to the range of a byte, inverts 8-bit numbers of a TIFF whose 0 is white, and
/// divides the colours of a TIFF's palette by 257, even if their factor was 256.
struct StoredNumbers {
    int bits = 0;  ///< the bits of a number, if no type has as many; else 0
    /// The colours, each of 8 bits, that pixels are indices into; empty: pixels are numbers or
    /// colours.
    std::vector<std::array<float, 3>> palette;
    /// The offset in the file of the 2 bytes of PhotometricInterpretation; 0: OpenImageIO does not
    /// change the numbers.
    std::uint64_t photometric_offset = 0;
    std::array<char, 2> photometric_bytes{};  ///< bytes that prevent the change
};

/// Reads these facts from a PNG or TIFF; other formats need none. InputError for a TIFF of other
/// colours than red, green and blue, such as CMYK, for a palette with alpha, and for numbers with a
/// sign or floats of an unusual size.
StoredNumbers read_stored_numbers(const std::filesystem::path& path, const std::string& format,
                                  const Location& where);

/// Restores the numbers of the file in an image, and replaces indices into a palette by colours.
/// Pixels of a palette whose index is the mark of unknown pixels get an alpha of 0. InputError for
/// a pixel beyond the palette.
void restore_numbers(const StoredNumbers& stored, const Location& where, Image& image);

}  // namespace sonarsim
