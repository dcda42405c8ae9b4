#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/child_process.h"

namespace sonarsim {

/// The pictures that a contact sheet shows.
struct SheetOptions {
    std::string sensor;                 ///< this sensor alone; empty: all
    std::optional<std::uint64_t> ping;  ///< this ping alone, counted from 0
    std::size_t most = 36;              ///< most pictures of each sensor of one dataset
    /// Limits of the child process that draws: memory for the libraries, a picture of 2^28 bytes
    /// and the buffers to scale it.
    ChildLimits limits{std::size_t{4} << 30, 600, 300.0};
};

struct SheetSummary {
    std::size_t pictures = 0;
};

/// Writes a contact sheet of the pictures of a dataset: some pings of each sensor, spread evenly,
/// with the sensor's name and the ping's number. For the variants of a mission, a sweep or a
/// collection it shows one picture of each, by its first sensor and from its middle ping. The file
/// is a PNG, a JPEG or a WebP, as its extension says. OpenImageIO draws it in a child process,
/// since damaged files make such libraries crash. InputError when a dataset or a picture is
/// damaged, when there is no picture, for another extension, and without OpenImageIO or its font.
SheetSummary write_contact_sheet(const std::filesystem::path& folder,
                                 const std::filesystem::path& file, const SheetOptions& options);

}  // namespace sonarsim
