#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace sonarsim {

/// What was left out of a scene, what is odd about its materials, and vertices that floats have
/// rounded.
std::vector<std::string> doubts_about(const Scene& scene);
/// Warns of it. Returns how many warnings that took.
std::size_t warn_about(const Scene& scene);

}  // namespace sonarsim
