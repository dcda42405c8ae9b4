#pragma once

#include <cstddef>
#include <span>

#include "mission/mission.h"
#include "scene/placed_file.h"
#include "sonar/sonar.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// The heights of a map that are left out.
struct Thinning {
    int every = 1;       ///< every n-th row and column is kept
    double error = 0.0;  ///< relative L1 of the images against those of all heights
};

/// True if no truth of the mission depends on the heights that thinning leaves out: it has no
/// labels, no soundings, no objects on the bottom and no multipath.
bool may_be_thinned(const Mission& mission);

/// Smaller maps are not thinned: they cost little.
inline constexpr std::size_t few_heights = std::size_t{1} << 18;

/// The greatest of 1, 2, 4, 8 and 16 for which every n-th row and column of a map is enough for the
/// sonars: their images change by no more than a quarter of `relative_l1`. That is measured: rays
/// see a part of each sonar's view from a few poses of the trajectory, one of them the lowest,
/// once over all heights and once over those that are kept. The greatest change of these images is
/// Thinning::error. A map with unknown heights keeps all. InputError as read_heights().
Thinning thin_heights(const PlacedFile& map, std::span<const Sonar> sonars,
                      const Trajectory& vehicle, double relative_l1, std::size_t few = few_heights);

}  // namespace sonarsim
