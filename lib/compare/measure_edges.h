#pragma once

#include "compare/images.h"
#include "compare/measured.h"

namespace sonarsim {

/// Adds the widths of the edges of imaging pings, along range and along bearing, beyond the
/// transmitter's ringing. Places are those of patches.
void measure_edges(const RecordedImages& images, PatchSize size, const Zones& zones,
                   Measurement& out);

}  // namespace sonarsim
