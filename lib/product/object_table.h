#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "labels/labels.h"
#include "ping/sonar.h"
#include "trace/ping.h"

namespace sonarsim {

/// One object in one ping. Its bins are those in which its echo is the largest.
struct SeenObject {
    std::uint32_t id = 0;                 ///< as in PingLabels
    int range_first = 0, range_last = 0;  ///< inclusive bounds of its bins
    int beam_first = 0, beam_last = 0;
    std::uint64_t bins = 0;
    double level = 0.0;                       ///< mean intensity of its bins
    std::optional<double> surrounding_level;  ///< mean intensity of the other bins around them
    double range_m = 0.0;                     ///< mean of its bins
    std::optional<double> azimuth_rad;        ///< mean of its bins, for a fan
    Eigen::AlignedBox3f box_sensor_m;         ///< box around its visible surface, sensor frame
};

/// The objects in a ping, sorted by id. `labels` gives the object of each bin, `ping` the levels.
/// The surroundings of an object are the box of its bins, enlarged on each side by half its size
/// and at least by two bins.
std::vector<SeenObject> seen_objects(const Sonar& sonar, const SceneObjects& objects,
                                     const TracedPing& traced, const PingLabels& labels,
                                     const Ping& ping);

}  // namespace sonarsim
