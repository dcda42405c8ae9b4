#pragma once

#include <span>
#include <string>

namespace sonarsim {

/// The place of a map in the world, or in a reference system. Row 0 is north, column 0 west.
struct MapPlace {
    double west_m = 0.0;   ///< x of the left edge
    double north_m = 0.0;  ///< y of the upper edge
    double cell_m = 1.0;
    int epsg = 0;  ///< code of the projected reference system; 0: none
};

/// A map as a GeoTIFF 1.1 (OGC 19-008r4): float32 [rows, columns], not compressed; NaN, the nodata
/// value, marks unknown cells. `values` has one or more rows of `columns` and less than 4 GB.
std::string geotiff_bytes(std::span<const float> values, int columns, const MapPlace& place);

}  // namespace sonarsim
