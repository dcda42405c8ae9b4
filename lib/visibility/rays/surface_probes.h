#pragma once

#include <cstddef>

#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/local_pose.h"
#include "visibility/rays/set_disagreement.h"
#include "visibility/view.h"

namespace sonarsim {

/// Estimates the share of signal that the image lacks, independently of the image's rays. About
/// `count` rays are cast to points of the view on triangles of the scene; all triangles are equally
/// likely. The visible points fall into bins. The result is the share of these bins' signal that
/// lies in bins where the image is dark, or 0 if no point is visible. Small triangles, where rays
/// miss surface, are probed most. Bodies, copies of shared meshes and beams that `image` does not
/// have are not probed. The points are the same for the same pose.
double share_of_dark_bins(const Scene& scene, const Caster& caster, const View& view,
                          const LocalPose& pose, const SetDisagreement& image, std::size_t count);

}  // namespace sonarsim
