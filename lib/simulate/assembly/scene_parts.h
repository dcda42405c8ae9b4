#pragma once

#include "input/mission/mission.h"
#include "input/scene/placed_file.h"
#include "input/scene/placing/bottom.h"
#include "input/trajectory/trajectory.h"
#include "simulate/assembly/scene_store.h"
#include "simulate/sonar/sonar.h"

namespace sonarsim {

/// The parts of a mission's scene.
struct SceneParts {
    std::vector<PlacedFile> files;    ///< scene.file, ground, objects, scattered objects
    std::vector<Trajectory> motions;  ///< motions of the moving objects, in their order; world
    /// The bottom that objects rest on, for the label `height`; null if not needed or not there.
    std::shared_ptr<const Bottom> bottom;
    std::shared_ptr<const Seabed> seabed;  ///< the part of scene.seabed that was made; null: none
    /// Sentences about files that may lie on their side.
    std::vector<std::string> orientation_warnings;
};

/// Places all objects of a mission: lowers objects to the bottom and draws the scattered ones.
/// `vehicle` gives the times of the pings; the sonars have their motions. Throws InputError with
/// the place in the mission for an object below the bottom or outside it, for one that finds no
/// room, and for a motion that does not last from the first to the last ping.
///
/// A heightmap or seabed is made where the sonars reach it or objects at rest stand on it.
///
/// With `places_only` a bed without an end is made below objects alone, and not a file.
SceneParts place_scene(const Mission& mission, const Trajectory& vehicle,
                       std::span<const Sonar> sonars, SceneStore& models, bool places_only = false);

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
