#pragma once

#include "input/mission/scene_keys.h"
#include "input/scene/materials.h"
#include "input/scene/scene.h"

namespace sonarsim {

/// Reads the maps of a mission and lays them on the scene, to which it adds the materials of the
/// maps. Warns of a map that lies outside the scene. InputError for a map that cannot be read, a
/// material that the table lacks, and instances that do not exist.
void apply_ground_maps(const SceneConfig& config, const MaterialTable& table, const Water& water,
                       Scene& scene);

}  // namespace sonarsim
