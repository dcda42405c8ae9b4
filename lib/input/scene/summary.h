#pragma once

#include <string>

#include "input/scene/materials.h"
#include "input/scene/scene.h"

namespace sonarsim {

/// Summary of a scene as lines of text: bounds, triangles and area, dropped parts, then a table of
/// materials and one of instances with their triangles and area.
std::string describe_scene(const Scene& scene);

/// A table of the scene's materials with their reflection in `water`; those not in the CSV marked.
std::string describe_materials(const Scene& scene, const MaterialTable& table, const Water& water);

}  // namespace sonarsim
