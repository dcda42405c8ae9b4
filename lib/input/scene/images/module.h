#pragma once

#include <cstddef>
#include <cstdint>

// The interface between the program and its module of images (apps/modules/images.cpp), which alone
// is linked with OpenImageIO and libtiff. C, so that a symbol's name is all that dlsym needs.

extern "C" {

struct SonarsimImageHead {
    std::uint64_t width;
    std::uint64_t height;
    std::uint32_t channels;
    std::uint32_t bits;      ///< bits of one value in the file
    std::uint32_t is_float;  ///< 1: the file holds floating-point numbers, 0: whole numbers
    /// 1: `grid` has the place of the pixels by the tags of a GeoTIFF: x and y of the centre of the
    /// first pixel, and the steps from one column and from one row to the next.
    std::uint32_t has_grid;
    std::uint32_t unit;  ///< 0: `grid` is in metres, 1: degrees, 2: the file does not say
    std::uint32_t epsg;  ///< code of the projected reference system; 0: none
    std::uint32_t heights_in_feet;  ///< 1: the file says so
    double grid[4];
    char no_data[64];  ///< GDAL's text for the value of unknown pixels; "": none
};

/// Called before the pixels are read. Returns room for width x height x channels values; null ends.
using SonarsimImageStart = float* (*)(void* user, const SonarsimImageHead* head);

/// Reads the first image of a file of `format` "png", "tiff" or "openexr" and opens no other file:
/// rows from the top, in them pixels from the left, in them channels. Whole numbers have their
/// value, not a share of the largest. Returns 0, or 1 with the reason in `error`, zero-terminated.
using SonarsimReadImage = int (*)(const char* format, const char* file, SonarsimImageStart start,
                                  void* user, char* error, std::size_t error_size);
}

namespace sonarsim {

inline constexpr const char* image_module = "images";
/// The number rises with every change above, so that a module of another version is not used.
inline constexpr const char* image_module_symbol = "sonarsim_read_image_5";

}  // namespace sonarsim
