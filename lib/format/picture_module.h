#pragma once

#include <cstddef>
#include <cstdint>

// The interface to the module that encodes pictures (apps/modules/encode_picture.cpp). Only the
// module is linked with OpenImageIO. The interface is C, so that dlsym needs only a symbol's name.

extern "C" {

/// One channel of a picture. Whole numbers keep their value. OpenEXR has no numbers of 8 and 16
/// bits: it stores them as half, which is exact up to 2,048, and as uint.
struct SonarsimChannel {
    const char* name;    ///< in OpenEXR: "LAYER.CHANNEL", or a channel of the first layer
    const void* values;  ///< the first pixel's value; rows from the top
    std::size_t step;    ///< bytes from one pixel to the next
    std::uint32_t type;  ///< 1: 8 bits, 2: 16 bits, both without a sign; 4: float
};

/// A list of numbers in the header.
struct SonarsimAttribute {
    const char* name;
    const float* numbers;
    std::size_t count;
};

struct SonarsimPicture {
    const char* format;       ///< "openexr", not compressed; "jpeg" or "webp", of quality 90
    const char* description;  ///< text in the header; "": none
    std::uint32_t width;
    std::uint32_t height;
    const SonarsimChannel* channels;
    std::size_t channel_count;
    const SonarsimAttribute* attributes;
    std::size_t attribute_count;
};

/// Takes the bytes of the whole file.
using SonarsimTakeBytes = void (*)(void* user, const void* bytes, std::size_t size);

/// Encodes a picture; any number of threads may do so at a time. Returns 0, or 1 with the reason in
/// `error`, which ends with a zero.
using SonarsimEncodePicture = int (*)(const SonarsimPicture* picture, SonarsimTakeBytes take,
                                      void* user, char* error, std::size_t error_size);
}

namespace sonarsim {

/// Raised with every change above, so that a module of another version is detected.
inline constexpr const char* encode_module_symbol = "sonarsim_encode_picture_1";

}  // namespace sonarsim
