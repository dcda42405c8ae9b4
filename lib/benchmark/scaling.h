#pragma once

#include <span>
#include <vector>

#include "benchmark/report.h"
#include "scene/scene.h"

namespace sonarsim {

/// Every triangle cut into four at the middles of its edges: the same shape of more triangles.
Scene subdivide(const Scene& scene);

/// n x n copies of the scene side by side, n odd, the original in the middle: the same density
/// over a larger area.
Scene tile(const Scene& scene, int n);

/// The time per ping of each sonar with rays and with the octree as the mission sets them (without
/// it where the scene shares meshes, which it cannot see), on the scene with 1, 4, 16 and 64 times
/// the triangles on the same shape and on 1, 9, 25 and 121 times the area, as far as
/// `most_triangles` allows.
std::vector<Growth> measure_growth(const Mission& mission, const Assembly& assembly,
                                   std::size_t most_triangles, const ReportOptions& options,
                                   const ReportProgress& progress);

}  // namespace sonarsim
