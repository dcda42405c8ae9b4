#pragma once

#include <cstddef>
#include <cstdint>

// The interface between the program and its module of images (apps/modules/images.cpp), which alone
// is linked with OpenImageIO. C, so that a symbol's name is all that dlsym needs.

extern "C" {

struct SonarsimImageHead {
    std::uint64_t width;
    std::uint64_t height;
    std::uint32_t channels;
    std::uint32_t bits;      ///< bits of one value in the file
    std::uint32_t is_float;  ///< 1: the file holds floating-point numbers, 0: whole numbers
};

/// Called before the pixels are read; another result than 0 ends the reading with success.
using SonarsimImageStart = int (*)(void* user, const SonarsimImageHead* head);
/// Called with `count` values of one row or more: rows from the top, in them pixels from the left,
/// in them channels. Whole numbers have their value, not a share of the largest.
using SonarsimImageRows = void (*)(void* user, const float* values, std::size_t count);

/// Reads the first image of a file of `format` "png", "tiff" or "openexr" and opens no other file.
/// Returns 0, or 1 with the reason in `error`, which ends with a zero.
using SonarsimReadImage = int (*)(const char* format, const char* file, SonarsimImageStart start,
                                  SonarsimImageRows rows, void* user, char* error,
                                  std::size_t error_size);
}

namespace sonarsim {

/// The number rises with every change above, so that a module of another version is not used.
inline constexpr const char* image_module_symbol = "sonarsim_read_image_1";

}  // namespace sonarsim
