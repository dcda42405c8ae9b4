#pragma once

#include <span>
#include <string>

#include "scene/gltf/scene_files.h"
#include "scene/placed_file.h"
#include "scene/surface.h"

namespace sonarsim {

/// The triangles of a file where it is placed, or of those of its nodes alone that fit one of
/// `nodes`. InputError as load_scene, and at the place of the file for a pattern that fits no node.
Surface surface_of(const PlacedFile& file, SceneFiles& models,
                   std::span<const std::string> nodes = {});

}  // namespace sonarsim
