#pragma once

#include <vector>

#include "scene/scene.h"
#include "trace/specular_path.h"
#include "trace/traced_ping.h"

namespace sonarsim {

/// The pieces of second surfaces that a ping's samples mirror sound to, and those that sound
/// reaches over two unequal ways (RetracedSurface::unequal). With t the length of the way to p in
/// units of |p_i| a piece is seen in the mirror at t p_i, and it has the area A_i (v_i . n_i) t^2 /
/// |r_i . n_h|: all the sound that meets the sample goes on to it, whatever lies between. The
/// water's surface scatters nothing back.
std::vector<SpecularPath> specular_paths(const TracedPing& traced, const Scene& scene);

}  // namespace sonarsim
