#pragma once

#include <span>

#include "mission/mission.h"
#include "scene/gltf/scene_files.h"
#include "scene/placed_file.h"
#include "sonar/sonar.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// The heights of a map that are left out.
struct Thinning {
    int every = 1;       ///< every n-th row and column is kept
    double error = 0.0;  ///< relative L1 of the images against those of all heights
};

/// True if thinning a mission's heightmap may be worth its time, and no truth depends on the
/// heights that it leaves out: the map has at least 2^18 heights, and the mission no labels, no
/// soundings, no objects on the bottom and no multipath. Reads the map.
bool may_be_thinned(const Mission& mission, const PlacedFile& map, SceneFiles& models);

/// True if the mission allows thinning and no truth depends on the heights that it leaves out.
bool allows_thinning(const Mission& mission);

/// The greatest of 1, 2, 4, 8 and 16 for which every n-th row and column of a map is enough for the
/// sonars: their images change by no more than a quarter of `relative_l1`. The change is measured
/// with rays over a part of each sonar's view from a few poses of the trajectory, one of them the
/// lowest: once over all heights and once over those that are kept. The greatest change of these
/// images is Thinning::error. A map with unknown heights keeps all. InputError as read_heights().
Thinning thin_heights(const PlacedFile& map, std::span<const Sonar> sonars,
                      const Trajectory& vehicle, double relative_l1, ImageReader& images);

}  // namespace sonarsim
