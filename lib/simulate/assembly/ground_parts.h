#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "input/mission/mission.h"
#include "input/mission/seabed_keys.h"
#include "input/scene/placed_file.h"
#include "input/scene/seabed/seabed.h"
#include "input/trajectory/trajectory.h"
#include "simulate/assembly/scene_store.h"
#include "simulate/sonar/sonar.h"

namespace sonarsim {

/// A box around the ground within the range of any ping and of its later groups of beams, world x
/// and y. Ground outside returns no echo and hides no surface that does. The sonars have their
/// motions. `faster`: the greatest speed of sound over that by which sonars measure ranges, or 1.
Eigen::AlignedBox2d ground_in_range(const Mission& mission, std::span<const Sonar> sonars,
                                    const Trajectory& vehicle, double faster);

/// A box around the ground that objects at rest may stand on; world x and y. Empty: there are none.
Eigen::AlignedBox2d ground_of_objects(const SceneConfig& scene, Shapes& shapes);

/// The part of a heightmap over a box of the world.
PlacedFile heightmap_of(const HeightmapConfig& heightmap, const Eigen::AlignedBox2d& needed);

/// The placed seabed of a mission, made above `needed`, world x and y. `announce` gets a sentence
/// before a large one is made; it may be null.
PlacedFile seabed_of(const SeabedConfig& config, std::uint64_t seed,
                     const Eigen::AlignedBox2d& needed,
                     const std::function<void(const std::string&)>& announce);

}  // namespace sonarsim
