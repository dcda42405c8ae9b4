#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/images/image.h"

namespace sonarsim {

/// The facts of a file whose numbers OpenImageIO would change: it spreads numbers of fewer bits
/// than a byte over all of it, inverts 8 bits of a TIFF whose 0 is white, and divides the colours
/// of a TIFF's palette by 257, even if 256 was their factor.
struct StoredNumbers {
    int bits = 0;  ///< the bits of a number, if no type has as many; else 0
    /// The colours that pixels point at, each of 8 bits; empty: pixels are numbers or colours.
    std::vector<std::array<float, 3>> palette;
    /// The place in the file of the word of 2 bytes that names their meaning; 0: OpenImageIO keeps
    /// them.
    std::uint64_t meaning_at = 0;
    std::array<char, 2> meaning{};  ///< the word that makes it keep them
};

/// Reads these facts from a PNG or TIFF; other formats need none. InputError for a TIFF of other
/// colours than red, green and blue, such as CMYK, for a palette with alpha, and for numbers with a
/// sign or floats of an unusual size.
StoredNumbers read_stored_numbers(const std::filesystem::path& path, const std::string& format,
                                  const Location& where);

/// Restores the numbers of the file in an image, and replaces indices into a palette by colours.
/// The mark of unknown pixels, a number, becomes an alpha of 0 in these. InputError for a pixel
/// beyond the palette.
void restore_numbers(const StoredNumbers& stored, const Location& where, Image& image);

}  // namespace sonarsim
