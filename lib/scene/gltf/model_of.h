#pragma once

#include "scene/gltf/scene_files.h"
#include "scene/placed_file.h"

namespace sonarsim {

/// The glTF of a placed file. InputError as SceneFiles::model, with the place in the mission that
/// names the file.
const tinygltf::Model& model_of(const PlacedFile& file, SceneFiles& models);

}  // namespace sonarsim
