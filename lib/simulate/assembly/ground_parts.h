#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "input/mission/mission.h"
#include "input/scene/placed_file.h"
#include "input/trajectory/trajectory.h"
#include "simulate/assembly/scene_store.h"
#include "simulate/sonar/sonar.h"

namespace sonarsim {

/// A box around the ground within the range of any ping and of its later groups of beams, world x
/// and y. Ground outside returns no echo and hides no surface that does. The sonars have their
/// motions. `faster`: the greatest speed of sound over that by which sonars measure ranges, or 1.
Eigen::AlignedBox2d ground_in_range(const Mission& mission, std::span<const Sonar> sonars,
                                    const Trajectory& vehicle, double faster);

/// A mission's heightmap or seabed, where a ping may receive it or an object stand; or none.
std::optional<PlacedFile> ground_of(const Mission& mission, const Trajectory& vehicle,
                                    std::span<const Sonar> sonars, SceneStore& models);

/// The part of a bed without an end on which objects stand; none for other grounds.
std::optional<PlacedFile> bed_of_objects(const Mission& mission, SceneStore& models);

}  // namespace sonarsim
