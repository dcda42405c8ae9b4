#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "labels/labels.h"
#include "ping/sonar.h"
#include "trace/ping.h"

namespace sonarsim {

/// What one ping shows of one object. Its bins are those to which it gives the most echo.
struct SeenObject {
    std::uint32_t id = 0;                 ///< as in PingLabels
    int range_first = 0, range_last = 0;  ///< of its bins, both inclusive
    int beam_first = 0, beam_last = 0;
    std::uint64_t bins = 0;
    double level = 0.0;                       ///< mean intensity of its bins
    std::optional<double> surrounding_level;  ///< of the bins around them that are not its own
    double range_m = 0.0;                     ///< mean of its bins
    std::optional<double> azimuth_rad;        ///< likewise; of a fan
    Eigen::AlignedBox3f box_sensor_m;         ///< around what is seen of it, sensor frame
};

/// The objects that a ping shows, by id. `labels` tells the object of each bin, `ping` is the image
/// whose levels are asked for. What surrounds an object is the box of its bins, grown to either
/// side by half its size and at least by two bins.
std::vector<SeenObject> seen_objects(const Sonar& sonar, const SceneObjects& objects,
                                     const TracedPing& traced, const PingLabels& labels,
                                     const Ping& ping);

}  // namespace sonarsim
