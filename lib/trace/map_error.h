#pragma once

#include <span>

#include "core/pose.h"
#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/view.h"

namespace sonarsim {

/// The estimated relative L1 that a scene's maps add to the noise-free image of a ping, since
/// lay_maps() takes their mean over pieces of surface. The error grows with the size of the pieces,
/// so the estimate is the change of the paper's image if the pieces are twice as large. 0 for a
/// side-scan sonar. The estimate for a fan of many beams uses a part of the samples, down to a
/// sixteenth: some blocks of range in each beam, others in the next beam. `samples` are those of
/// the engine.
double error_of_maps(const Scene& scene, const View& view, const Pose& T_world_sensor,
                     const Samples& samples);

/// The factor by which a scene's maps raise an engine's estimated error: the change between the two
/// images of its compared beams with the maps, divided by the change without the maps. At least 1;
/// 1 if no beams are compared.
double growth_by_maps(const Scene& scene, const View& view, const Pose& T_world_sensor,
                      std::span<const ComparedBeam> compared);

}  // namespace sonarsim
