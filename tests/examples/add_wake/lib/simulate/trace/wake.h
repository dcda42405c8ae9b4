#pragma once

#include <Eigen/Geometry>

#include "core/pose.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// A cloud of bubbles behind a ship. Sound loses power on its way through it and comes back from
/// it.
struct Wake {
    Eigen::AlignedBox3d box_m;      ///< world
    float absorption_per_m = 0.0F;  ///< one way: power falls as e^-(absorption times length)
    float scattering_per_m = 0.0F;  ///< backscattering cross-section of a cubic metre, 1/m
    double cell_m = 0.25;           ///< one sample stands for a cube of this edge
};

/// The length of the straight way from `from` to `to` in the box, m.
double length_within(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
                     const Eigen::Vector3d& to);

/// Weakens the samples behind or in the wake, and adds those of the wake that nothing hides, of the
/// kind `kind`. `samples` are in the sensor's frame.
void add_wake(const Wake& wake, SampleKind kind, const VisibilityEngine& engine,
              const Pose& T_world_sensor, Samples& samples);

}  // namespace sonarsim
