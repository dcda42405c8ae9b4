#pragma once

#include "core/pose.h"
#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/view.h"

namespace sonarsim {

/// The estimated relative L1 that a scene's maps add to the noise-free image of a ping, since
/// lay_maps() takes their mean over pieces of surface: the change of the paper's image from
/// pieces twice as large, as an error in proportion to their size has it. A part of
/// the samples of a fan of many beams is looked at, down to a sixteenth: ranges in every beam,
/// shifted from beam to beam. `samples` are those of the engine.
double error_of_maps(const Scene& scene, const View& view, const Pose& T_world_sensor,
                     const Samples& samples);

}  // namespace sonarsim
