#pragma once

#include "core/pose.h"
#include "simulate/visibility/clusters_in_view.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// 1 for the bins of a view that contain surface, visible or hidden, else 0: [beams, range bins],
/// beam after beam. Surface within a thousandth of a bin of a border may count on either side.
std::vector<std::uint8_t> covered_bins(const SceneClusters& surface, const View& view,
                                       const Pose& T_world_sensor,
                                       std::span<const Pose> T_world_body = {});

}  // namespace sonarsim
