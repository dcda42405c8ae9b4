#pragma once

#include <cstddef>
#include <cstdint>

// The interface to the module that draws contact sheets (apps/modules/contact_sheet.cpp). Only the
// module is linked with OpenImageIO. The interface is C, so that dlsym needs only a symbol's name.

extern "C" {

struct SonarsimThumbnail {
    const char* file;      ///< a PNG; a JPEG or a WebP if its name ends in .jpg or .webp
    const char* caption;   ///< lines in ASCII
    std::uint32_t turned;  ///< 1: by half a turn
};

struct SonarsimSheet {
    const SonarsimThumbnail* thumbnails;  ///< row by row
    std::size_t count;
    std::size_t columns;
    std::uint32_t side_px;  ///< the greatest width and height of a thumbnail
    const char* font;       ///< a TrueType file
    const char* format;     ///< "png", "jpeg" or "webp"
    const char* out;        ///< the file to write
};

/// Writes a contact sheet. Returns 0, or 1 with the reason in `error`, which ends with a zero.
using SonarsimWriteSheet = int (*)(const SonarsimSheet* sheet, char* error, std::size_t error_size);
}

namespace sonarsim {

/// Raised with every change above, so that a module of another version is detected.
inline constexpr const char* sheet_module_symbol = "sonarsim_write_sheet_1";

}  // namespace sonarsim
