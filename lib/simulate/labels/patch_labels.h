#pragma once

#include <cstdint>
#include <span>

#include "input/scene/placing/bottom.h"
#include "simulate/trace/ping_motion.h"
#include "simulate/trace/surface_echoes.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// Labels of the visible surface in the bins, [beams, range_bins], beam after beam, NaN before.
/// Empty: not requested.
struct PatchLabels {
    std::span<float> elevation_rad, elevation_spread_rad;  ///< both or none
    std::span<float> height_m;
};

/// Fills these labels. The bins that a patch covers are computed once for all of them. Without a
/// `bottom` nothing has a height. `is_bottom`: that of the scene.
void label_patches(const SurfaceEchoes& echoes, const View& view, const TruePlaces& places,
                   const Bottom* bottom, std::span<const std::uint8_t> is_bottom,
                   const PatchLabels& labels);

}  // namespace sonarsim
