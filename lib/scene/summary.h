#pragma once

#include <string>

#include "scene/materials.h"
#include "scene/scene.h"

namespace sonarsim {

/// What a person wants to know of a scene, as lines of text: bounds, triangles and area, then a
/// table of materials and one of instances with their triangles and area, and what was dropped.
std::string describe_scene(const Scene& scene);

/// A table of what a CSV says of the scene's materials, with their power reflection coefficients in
/// `water`. Those that it lacks say so.
std::string describe_materials(const Scene& scene, const MaterialTable& table, const Water& water);

}  // namespace sonarsim
