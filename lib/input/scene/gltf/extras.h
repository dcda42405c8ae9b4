#pragma once

#include <tiny_gltf.h>

#include <string>

#include "core/error.h"

namespace sonarsim {

/// extras.sonar.material, or "".
std::string sonar_material(const tinygltf::Value& extras);

/// extras.sonar.class, or "".
std::string sonar_class(const tinygltf::Value& extras);

/// InputError for an extras.sonar of a node or a material that is not an object, or that holds
/// another key or another type than the texts above.
void check_extras(const tinygltf::Model& model, const Location& where);

}  // namespace sonarsim
