#pragma once

#include <string>
#include <vector>

#include "input/scene/placed_file.h"
#include "simulate/assembly/assemble.h"

namespace sonarsim {

/// The files of a mission's scene.
struct SceneParts {
    std::vector<PlacedFile> files;  ///< scene.file, ground, objects, scattered objects
    /// Sentences about files that may lie on their side.
    std::vector<std::string> orientation_warnings;
};

/// Places all objects of a mission: lowers objects to the bottom and draws the scattered ones. The
/// assembly has its trajectory and sonars with their motions, and gets the motions of the objects,
/// the bottom where it is needed, and the seabed. Throws InputError with the place in the mission
/// for an object below the bottom or outside it, for one that finds no room, and for a motion that
/// does not last from the first to the last ping.
///
/// A heightmap or seabed is made where the sonars reach it or objects at rest stand on it.
///
/// With `places_only` a bed without an end is made below the objects alone and is none of the
/// files.
SceneParts place_scene(const Mission& mission, SceneStore& models, bool places_only,
                       Assembly& assembly);

}  // namespace sonarsim
