#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "run/preview/scene_views.h"
#include "simulate/assembly/assemble.h"

namespace sonarsim {

/// A mission at a pose as a binary glTF file, for any viewer: the surfaces of the scene in colours
/// of their classes (background grey), the trajectory, and the edges of the sonars' views. Metres
/// from Scene::origin, turned from z up to the y up of glTF. Nodes have the names of instances,
/// and the names of class and object in `extras`.
std::string scene_gltf(const Assembly& assembly, std::uint32_t pose,
                       const std::vector<BeamOutline>& beams);

}  // namespace sonarsim
