#pragma once

#include "simulate/ping/form_image.h"
#include "simulate/reference/reference.h"

namespace sonarsim {

/// The ground truth of the calibrated model, where energies add: its expected image, without
/// speckle and noise, from single points of the surface, each with the area that it represents. The
/// number of points grows until the image has settled. Casts rays as cast_reference() does.
/// `settings` must be of a calibrated sonar. Its targets are sampled as in a ping, since points of
/// their flat triangles would be another surface; so errors of targets do not show. Sound through
/// thin walls continues from the points as it does from samples.
Reference cast_energy_reference(const Caster& caster, const Scene& scene,
                                const PingSettings& settings, const Pose& T_world_sensor,
                                const ReferenceGoal& goal);

}  // namespace sonarsim
