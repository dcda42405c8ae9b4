#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mission/mission.h"
#include "scene/gltf/scene_files.h"
#include "scene/placed_file.h"
#include "scene/placing/bottom.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// The parts of a mission's scene.
struct SceneParts {
    std::vector<PlacedFile> files;    ///< scene.file, ground, objects, scattered objects
    std::vector<Trajectory> motions;  ///< motions of the moving objects, in their order; world
    /// The bottom that objects rest on, for the label `height`; null if not needed or not there.
    std::shared_ptr<const Bottom> bottom;
    std::shared_ptr<const Seabed> seabed;  ///< the part of scene.seabed that was made; null: none
    std::vector<std::string> questions;    ///< sentences about files that may lie on their side
};

/// Places all objects of a mission: lowers objects to the bottom and draws the scattered ones.
/// `vehicle` gives the times of the pings. Throws InputError with the place in the mission for an
/// object below or beside the bottom, for one that finds no room, and for a motion that does not
/// last from the first to the last ping.
///
/// `seen` is the ground that the sonars can reach, world x and y: of a heightmap or seabed no
/// more is made than this and what still objects stand on.
SceneParts place_scene(const Mission& mission, const Trajectory& vehicle,
                       const Eigen::AlignedBox2d& seen, SceneFiles& models);

}  // namespace sonarsim
