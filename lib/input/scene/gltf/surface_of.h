#pragma once

#include <span>
#include <string>

#include "input/scene/gltf/scene_files.h"
#include "input/scene/placed_file.h"
#include "input/scene/surface.h"

namespace sonarsim {

/// The triangles of a placed file, or only of its nodes that match one of `nodes`. InputError as
/// load_scene, and at the place of the file for a pattern that matches no node.
Surface surface_of(const PlacedFile& file, SceneFiles& models,
                   std::span<const std::string> nodes = {});

}  // namespace sonarsim
