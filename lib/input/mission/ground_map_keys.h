#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "input/mission/limits.h"

// The keys of the maps that apply to the ground, with their defaults and their descriptions as
// in mission.h.

namespace sonarsim {

/// Pairs of a name and its replacement, in the order of the file.
using Renaming = std::vector<std::pair<std::string, std::string>>;

/// An image that applies to the ground from above. Pixels of a backscatter map are decibels.
struct AppliedMapConfig {
    std::filesystem::path file;
    double pixel_m = 0.0;              ///< size of a pixel; 0: by the file
    std::array<double, 2> origin_m{};  ///< point of the map that is the world's (0, 0)
    Location place = {};
};

/// An image whose pixels are materials.
struct SedimentMapConfig : AppliedMapConfig {
    Renaming materials;  ///< from a pixel's value or its colour to a material
};

/// The keys that say where an image lies.
template <class Visitor, class Config>
void describe_image_place(Visitor& v, Config& c) {
    v.number("pixel_m", c.pixel_m, above(0),
             "size of a pixel; `auto` takes the GeoTIFF tags or the world file", or_auto);
    v.array("origin_m", c.origin_m, any_position_m,
            "coordinates of the map that become x = 0, y = 0; with pixel_m from its south-west "
            "corner");
}

template <class Visitor>
void describe(Visitor& v, AppliedMapConfig& c) {
    v.path("file", c.file, "an image, PNG, TIFF (GeoTIFF) or OpenEXR, whose first row is the north",
           required);
    describe_image_place(v, c);
}

template <class Visitor>
void describe(Visitor& v, SedimentMapConfig& c) {
    describe(v, static_cast<AppliedMapConfig&>(c));
    v.text("materials", c.materials,
           "the material of each value, as {1: sand, 2: gravel}, or of each colour, as "
           "{\"#c8b478\": sand}");
    v.require(!c.materials.empty(), {"materials"},
              "'materials' must name the material of each value of the image, as {1: sand}");
}

}  // namespace sonarsim
