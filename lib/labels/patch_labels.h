#pragma once

#include <span>

#include "core/pose.h"
#include "scene/placing/bottom.h"
#include "trace/surface_echoes.h"
#include "visibility/view.h"
#include "water/sound_profile.h"

namespace sonarsim {

/// Labels of the visible surface in the bins, [beams, range_bins], beam after beam. Empty: not
/// asked for.
struct PatchLabels {
    std::span<float> elevation_rad, elevation_spread_rad;  ///< both or none
    std::span<float> height_m;
};

/// Fills these labels. They share the bins that a patch covers, which are worked out once for it.
/// Without a `bottom` nothing has a height. `profile` bends the sound, if not null.
void label_patches(const SurfaceEchoes& echoes, const View& view, const Pose& T_world_sensor,
                   const Bottom* bottom, const PatchLabels& labels,
                   const SoundProfile* profile = nullptr);

}  // namespace sonarsim
