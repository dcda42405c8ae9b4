#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace sonarsim {

/// Warnings about a scene: rejected triangles, unlikely materials, and vertices that floats have
/// rounded.
std::vector<std::string> warnings_about(const Scene& scene);
/// Logs these warnings. Returns their number.
std::size_t warn_about(const Scene& scene);

}  // namespace sonarsim
