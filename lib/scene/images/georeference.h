#pragma once

#include <filesystem>
#include <optional>

#include "scene/images/pixel_grid.h"

namespace sonarsim {

/// The place of an image on its map, as its file has it.
struct Georeference {
    std::optional<PixelGrid> grid;
    bool in_degrees = false;        ///< `grid` has longitudes and latitudes, not metres
    std::optional<double> no_data;  ///< the value of unknown pixels
};

/// Reads the tags of GeoTIFF 1.1 (OGC 19-008r4) and GDAL's tag of unknown pixels, else a world
/// file next to the image: map.tfw, map.tifw or map.wld for map.tif. The tie point belongs to the
/// outer corner of its pixel, or to its centre where the file says so (GTRasterTypeGeoKey), and the
/// coordinates of a world file always to the centre. Feet become metres. InputError for a grid
/// that is turned, and for tags that cannot be read.
Georeference read_georeference(const std::filesystem::path& image);

}  // namespace sonarsim
