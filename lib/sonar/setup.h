#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "core/pose.h"
#include "mission/mission.h"
#include "sonar/kinds.h"

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

/// T_vehicle_sensor by the configuration of the sonar.
void set_mount(Sonar& sonar, const KindOfSonar& kind);

/// The mount, the view and the range edges of a sonar, by its configuration and its kind.
Sonar common_sonar(const SonarConfig& config, const AccuracyConfig& accuracy,
                   const KindOfSonar& kind);

/// The azimuth edges of a fan of equal beams.
void add_azimuth(Sonar& sonar);

/// The paper's model with the noise and the streaks of the sonar's configuration. Over the beams of
/// a fan the noise has the lobe of Eq. 10, 1 + 0.5 exp(-phi^2 / (2 sigma^2)), if the mission wants
/// it.
std::shared_ptr<const EchoModel> paper_model(const Sonar& sonar, const KindOfSonar& kind);

/// The calibrated model with the instrument of the sonar's configuration; sets the azimuth edges
/// where beams are spaced by sine.
std::shared_ptr<const EchoModel> instrument_model(Sonar& sonar, const WaterConfig& water);

/// The mount of the sonars that look down: x along the vehicle's -z, z along its x, so that
/// azimuth runs from starboard (-) to port (+).
Pose looking_down();

/// For metadata, where what is absent is null.
nlohmann::ordered_json number_or_null(const std::optional<double>& value);

}  // namespace sonarsim
