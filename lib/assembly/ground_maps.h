#pragma once

#include <span>

#include "mission/scene_config.h"
#include "scene/gltf/scene_files.h"
#include "scene/materials.h"
#include "scene/placed_file.h"
#include "scene/scene.h"

namespace sonarsim {

/// Reads the maps of a mission and lays them on the scene, to which it adds the materials of the
/// maps. Warns of a map that lies outside the scene. InputError for a map that cannot be read, a
/// material that the table lacks, and instances that do not exist. `files` are those that the scene
/// was loaded from, for maps that texture coordinates place.
void lay_ground_maps(const SceneConfig& config, const MaterialTable& table, const Water& water,
                     std::span<const PlacedFile> files, SceneFiles& models, Scene& scene);

}  // namespace sonarsim
