#pragma once

#include <cstddef>

#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/local_pose.h"
#include "visibility/rays/set_disagreement.h"
#include "visibility/view.h"

namespace sonarsim {

/// The share of signal that the image lacks, by a count that does not depend on its rays: about
/// `count` rays are cast to points of the view on triangles of the scene, each triangle as likely
/// as any other. The points that are seen fall into bins; the share is the signal of the dark ones
/// among these, and 0 if no point is seen. Small triangles are where rays miss surface, and they
/// are probed most. Bodies and copies of shared meshes are not probed, nor beams that `image` does
/// not have. The points are the same for the same pose.
double share_of_dark_bins(const Scene& scene, const Caster& caster, const View& view,
                          const LocalPose& pose, const SetDisagreement& image, std::size_t count);

}  // namespace sonarsim
