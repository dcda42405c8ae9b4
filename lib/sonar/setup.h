#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/pose.h"
#include "mission/mission.h"
#include "ping/pixel_noise.h"

namespace sonarsim {

// What the sonars share when they are set up.

/// `bins` + 1 equally spaced values from `low` to `high`, both exact.
std::vector<double> edges(double low, double high, int bins);

/// T_vehicle_sensor: the sonar's default mount, turned by the mission's roll, pitch and yaw and
/// moved by its translation.
Pose mounted(const MountConfig& mount, const Pose& T_vehicle_default);

/// The number under which a sensor draws its noise: a hash of its name, so that adding another
/// sensor to a mission changes no draw.
std::uint32_t stream_of(std::string_view sensor_name);

/// [10-13]. `gain` is the m of I (m + w_m).
PixelNoise pixel_noise(const SonarConfig& config, double gain,
                       std::span<const double> range_edges_m,
                       std::span<const double> azimuth_edges_rad);

}  // namespace sonarsim
