#pragma once

#include <vector>

#include "compare/images.h"
#include "compare/measured.h"

namespace sonarsim {

/// Intervals that both recordings have, for levels by range and by bearing.
struct CommonBands {
    double range_from_m = 0.0, range_to_m = 0.0;
    double bearing_from_rad = 0.0, bearing_to_rad = 0.0;  ///< equal: no bearings
};

struct MeasureOptions {
    PatchSize patch;
    Zones zones;
    CommonBands bands;
};

/// All figures of images. Locations are patches, which do not overlap; the location of a patch is
/// the same in each image.
Measurement measure_images(const RecordedImages& images, const MeasureOptions& options);

}  // namespace sonarsim
