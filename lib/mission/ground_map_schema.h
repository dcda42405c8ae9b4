#pragma once

#include <array>

#include "mission/ground_map_config.h"
#include "mission/limits.h"

// The keys of the maps that are laid on the ground. As in mission/schema.h.

namespace sonarsim {

/// The keys that say where an image lies.
template <class Visitor, class Config>
void describe_image_place(Visitor& v, Config& c) {
    v.number("pixel_m", c.pixel_m, above(0),
             "size of a pixel; `auto` takes the GeoTIFF tags or the world file, which "
             "pixel_m and size_m replace",
             or_auto);
    v.array("size_m", c.size_m, above(0),
            "extent of the map along x and y, from edge to edge, instead of pixel_m");
    v.array("origin_m", c.origin_m, any_position_m,
            "the point of the map, in its own coordinates, that becomes x = 0, y = 0 of the "
            "mission. With pixel_m or size_m they begin at the map's south-west corner");
}

template <class Visitor>
void describe_laid_map(Visitor& v, LaidMapConfig& c) {
    v.path("file", c.file, "an image, PNG, TIFF (GeoTIFF) or OpenEXR, whose first row is the north",
           required);
    describe_image_place(v, c);
    v.require(c.pixel_m == 0.0 || !c.size_m, {"pixel_m", "size_m"},
              "give pixel_m or size_m, not both");
}

template <class Visitor>
void describe(Visitor& v, SedimentMapConfig& c) {
    describe_laid_map(v, c.laid);
    v.text("materials", c.materials,
           "the material of each value, as {1: sand, 2: gravel}, or of each colour, as "
           "{\"#c8b478\": sand}");
    v.require(!c.materials.empty(), {"materials"},
              "'materials' must name the material of each value of the image, as {1: sand}");
}

template <class Visitor>
void describe(Visitor& v, BackscatterMapConfig& c) {
    describe_laid_map(v, c.laid);
    v.number("scale_db", c.scale_db, {-1000, 1000}, "decibels for each step of the pixels' values");
    v.number("offset_db", c.offset_db, {-1000, 1000}, "decibels of the value 0");
}

}  // namespace sonarsim
