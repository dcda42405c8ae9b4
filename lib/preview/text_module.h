#pragma once

#include <cstddef>
#include <cstdint>

// The interface to the module that writes texts into pictures (apps/modules/texts.cpp). Only the
// module is linked with OpenImageIO. The interface is C, so that dlsym needs only a symbol's name.

extern "C" {

/// A line of text over a picture.
struct SonarsimText {
    const char* text;      ///< UTF-8; beyond ASCII only the degree sign is drawn
    std::int32_t x;        ///< pixel of the left end, the middle or the right end
    std::int32_t y;        ///< pixel of the middle of a digit's height
    std::int32_t align;    ///< 0: x is the left end, 1: the middle, 2: the right end
    std::int32_t size_px;  ///< size of the font
    std::uint8_t colour[3];
    std::uint8_t outlined;  ///< 1: with a dark outline, to be legible on any picture
};

/// Writes texts over `pixels`, RGB of 8 bits row by row. Returns 0, or 1 with the reason in
/// `error`, which ends with a zero.
using SonarsimWriteTexts = int (*)(std::uint8_t* pixels, std::uint32_t width, std::uint32_t height,
                                   const SonarsimText* texts, std::size_t count, const char* font,
                                   char* error, std::size_t error_size);
}

namespace sonarsim {

/// Raised with every change above, so that a module of another version is detected.
inline constexpr const char* text_module_symbol = "sonarsim_write_texts_1";

}  // namespace sonarsim
