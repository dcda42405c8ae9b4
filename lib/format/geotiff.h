#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace sonarsim {

/// Where the cells of a map lie in the world. Row 0 is north, column 0 west.
struct MapPlace {
    double west_m = 0.0;   ///< world x of the left edge
    double north_m = 0.0;  ///< world y of the upper edge
    double cell_m = 1.0;
};

/// Writes a map as a TIFF with the tags of GeoTIFF 1.1 (OGC 19-008r4), so that GDAL and QGIS put it
/// in its place: float32 [rows, columns], not compressed, NaN where nothing is known, which is also
/// the map's nodata value. The world's frame has no name on Earth, so no reference system is
/// given. `values` has a whole number of rows of `columns`, at least one, and less than 4 GB.
///
/// std::system_error when the disk does not take the file.
void write_geotiff(const std::filesystem::path& path, std::span<const float> values, int columns,
                   const MapPlace& place);

struct GeotiffShape {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::uint64_t file_bytes = 0;  ///< that such a file has
};

/// What the start of a file, its header at least, tells of a map that write_geotiff() wrote.
/// std::runtime_error where it is none.
GeotiffShape geotiff_shape(std::string_view start);

}  // namespace sonarsim
