#pragma once

#include <string>

#include "scene/scene.h"

namespace sonarsim {

/// What a person wants to know of a scene, as lines of text: bounds, triangles and area, then a
/// table of materials and one of instances with their triangles and area, and what was dropped.
std::string describe_scene(const Scene& scene);

}  // namespace sonarsim
