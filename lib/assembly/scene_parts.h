#pragma once

#include <memory>
#include <vector>

#include "mission/mission.h"
#include "scene/gltf/scene_files.h"
#include "scene/placed_file.h"
#include "scene/placing/bottom.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// What a mission's scene is made of.
struct SceneParts {
    std::vector<PlacedFile> files;    ///< scene.file, objects, and what is scattered, in this order
    std::vector<Trajectory> motions;  ///< of those that move, in their order; world
    /// What objects rest on, where the label `height` asks for it and there is one.
    std::shared_ptr<const Bottom> bottom;
};

/// Places all objects of a mission: those on the bottom are lowered to it, those that are scattered
/// are drawn. `vehicle` says when the sonars ping. InputError with the place in the mission for an
/// object below or beside the bottom, for one that finds no room, and for a motion that does not
/// last from the first to the last ping.
SceneParts place_scene(const Mission& mission, const Trajectory& vehicle, SceneFiles& models);

}  // namespace sonarsim
