#pragma once

#include <vector>

#include "scene/scene.h"
#include "trace/specular_path.h"
#include "trace/traced_ping.h"

namespace sonarsim {

/// The pieces of second surfaces that receive specular reflections of a ping's samples, and those
/// that sound reaches over two unequal ways (RetracedSurface::unequal). With t the length of the
/// path to p in units of |p_i|, the image of a piece lies at t p_i, and its area is A_i (v_i . n_i)
/// t^2 / |r_i . n_h|: it receives all sound that meets the sample. The water's surface scatters
/// nothing back.
std::vector<SpecularPath> specular_paths(const TracedPing& traced, const Scene& scene);

}  // namespace sonarsim
