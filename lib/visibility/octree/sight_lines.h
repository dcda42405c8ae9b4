#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/caster.h"
#include "visibility/engine.h"
#include "visibility/local_pose.h"

namespace sonarsim {

/// The indices of the samples whose middle the sonar sees, ascending, by a ray to each of them.
/// Surface in the way hides a sample when it lies nearer by more than the sample's own surface may
/// stray from its plane, `thickness_m` [samples], and not in that plane. `reach_m` is the greatest
/// range.
std::vector<std::uint32_t> in_sight(const Caster& caster, const LocalPose& pose, float reach_m,
                                    std::span<const Sample> samples,
                                    std::span<const float> thickness_m);

}  // namespace sonarsim
