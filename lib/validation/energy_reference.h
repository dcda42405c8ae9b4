#pragma once

#include "ping/form_image.h"
#include "validation/reference.h"

namespace sonarsim {

/// The truth for the calibrated model, where energies add: its expected image, without speckle and
/// noise, of as many single points of the surface as it takes to settle, each with the area that it
/// stands for. Casts as cast_reference() does. `settings` must be of a calibrated sonar.
Reference cast_energy_reference(const Caster& caster, const Scene& scene,
                                const PingSettings& settings, const Pose& T_world_sensor,
                                const ReferenceGoal& goal);

}  // namespace sonarsim
