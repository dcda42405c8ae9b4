#pragma once

#include "compare/images.h"
#include "compare/measured.h"

namespace sonarsim {

/// Adds the figures of the shadows of a side-scan: their share of the image beyond the water, their
/// depth and the width of their far edges. Places are those of patches.
void measure_shadows(const RecordedImages& images, PatchSize size, const Zones& zones,
                     Measurement& out);

}  // namespace sonarsim
