#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/caster.h"
#include "visibility/engine.h"
#include "visibility/local_pose.h"

namespace sonarsim {

/// Indices of the samples whose middle is visible from the sonar, ascending. One ray to each sample
/// decides. Surface in the way hides a sample if it is nearer by more than `thickness_m` [samples],
/// the deviation of the sample's own surface from its plane, and does not lie in that plane.
/// `reach_m` is the greatest range.
std::vector<std::uint32_t> in_sight(const Caster& caster, const LocalPose& pose, float reach_m,
                                    std::span<const Sample> samples,
                                    std::span<const float> thickness_m);

}  // namespace sonarsim
