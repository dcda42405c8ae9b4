#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mission/source_location.h"

namespace sonarsim {

/// Pairs of a name and its replacement, in the order of the file.
using Renaming = std::vector<std::pair<std::string, std::string>>;

/// An image that is laid on the ground from above.
struct LaidMapConfig {
    std::filesystem::path file;
    double pixel_m = 0.0;                         ///< size of a pixel; 0: by size_m, or by the file
    std::optional<std::array<double, 2>> size_m;  ///< x, y, from edge to edge of the map
    std::array<double, 2> origin_m{};             ///< point of the map that is the world's (0, 0)
    SourceLocation place;

    bool operator==(const LaidMapConfig&) const = default;
};

/// An image whose pixels are materials.
struct SedimentMapConfig {
    LaidMapConfig laid;
    Renaming materials;  ///< from a pixel's value or its colour to a material

    bool operator==(const SedimentMapConfig&) const = default;
};

/// An image whose pixels are decibels.
struct BackscatterMapConfig {
    LaidMapConfig laid;
    double scale_db = 1.0;  ///< decibels of a step of the pixels' values
    double offset_db = 0.0;

    bool operator==(const BackscatterMapConfig&) const = default;
};

}  // namespace sonarsim
