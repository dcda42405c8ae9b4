#pragma once

#include "input/scene/images/module.h"

/// Adds to `head` the place of a TIFF's pixels by its tags (OGC GeoTIFF 1.1, 19-008r4) and the text
/// of GDAL's tag for the value of unknown pixels. std::runtime_error for a TIFF that OpenImageIO
/// 2.4 reads wrongly or in part without an error, and for one whose place is no plain grid.
void read_tiff_header(const char* file, SonarsimImageHead& head);
