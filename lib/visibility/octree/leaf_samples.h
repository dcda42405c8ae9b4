#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/engine.h"
#include "visibility/local_pose.h"
#include "visibility/octree/tree.h"

namespace sonarsim {

/// The visible parts of the leaves in view.
Samples leaf_samples(const Octree& tree, const Caster& caster, const Scene& scene,
                     const PreparedView& prepared);

/// The paper's method without changes, as the baseline of the report: every leaf in view is
/// represented by its cube's centre and has one vote. In every pixel of azimuth and elevation the
/// leaves are sorted by range, and the first cluster, which ends at a gap of more than four leaves,
/// is kept.
Samples literal_samples(const Octree& tree, const Scene& scene, const PreparedView& prepared);

/// Indices of the samples whose middle is visible from the sonar, ascending. One ray to each sample
/// decides. Surface in the way hides a sample if it is nearer by more than `thickness_m` [samples],
/// the deviation of the sample's own surface from its plane, and does not lie in that plane.
/// `reach_m` is the greatest range.
std::vector<std::uint32_t> in_sight(const Caster& caster, const LocalPose& pose, float reach_m,
                                    std::span<const Sample> samples,
                                    std::span<const float> thickness_m);

}  // namespace sonarsim
