#pragma once

#include <span>

#include "core/pose.h"
#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/view.h"

namespace sonarsim {

/// The estimated relative L1 that a scene's maps add to the noise-free image of a ping, since
/// lay_maps() takes their mean over pieces of surface: the change of the paper's image from
/// pieces twice as large, as an error in proportion to their size has it. 0 for a side-scan. A part
/// of the samples of a fan of many beams is looked at, down to a sixteenth: ranges in every beam,
/// shifted from beam to beam. `samples` are those of the engine.
double error_of_maps(const Scene& scene, const View& view, const Pose& T_world_sensor,
                     const Samples& samples);

/// The growth of an engine's estimated error by a scene's maps: the change between the two
/// images of each of its compared beams with the maps, over that without them. 1 without such
/// beams, and no less.
double growth_by_maps(const Scene& scene, const View& view, const Pose& T_world_sensor,
                      std::span<const ComparedBeam> compared);

}  // namespace sonarsim
