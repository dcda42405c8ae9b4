#pragma once

#include <span>
#include <vector>

#include "benchmark/report.h"
#include "scene/scene.h"

namespace sonarsim {

/// Cuts every triangle into four at the midpoints of its edges: the same shape with more triangles.
Scene subdivide(const Scene& scene);

/// n x n adjacent copies of the scene, n odd, with the original in the middle: the same density
/// over a larger area.
Scene tile(const Scene& scene, int n);

/// The time per ping of each sonar with rays and with the octree of the mission (rays only if the
/// scene shares meshes, which the octree does not support), on the scene with 1, 4, 16 and 64 times
/// the triangles on the same shape and on 1, 9, 25 and 121 times the area, up to `most_triangles`.
std::vector<Growth> measure_growth(const Mission& mission, const Assembly& assembly,
                                   std::size_t most_triangles, const ReportOptions& options,
                                   const ReportProgress& progress);

}  // namespace sonarsim
