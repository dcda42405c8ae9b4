#pragma once

#include <filesystem>

#include "input/scene/images/image_place.h"

namespace sonarsim {

/// True if the file begins like a PNG, TIFF or OpenEXR image.
bool is_image_file(const std::filesystem::path& path);

/// Reads a PNG, TIFF (GeoTIFF, BigTIFF) or OpenEXR image through OpenImageIO; its content says
/// which. Reads the first of several images in a file. Its place on the map is that of its GeoTIFF
/// tags, else that of a world file next to it. InputError for a file that is damaged, has another
/// format or more values than `max_image_values` or `max_row_values`, or that OpenImageIO would
/// read wrongly, and without OpenImageIO.
Image read_image(const std::filesystem::path& path);

/// The EPSG code of the projected reference system of a GeoTIFF; 0 if it names none, or for another
/// image. InputError as above.
int epsg_of(const std::filesystem::path& path);

}  // namespace sonarsim
