#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/pose.h"
#include "input/mission/mission.h"
#include "simulate/trace/echo_model.h"
#include "simulate/trace/traced_ping.h"
#include "simulate/water/sound_profile.h"

namespace sonarsim {

/// The settings of a sonar for the trace and the image of a ping.
struct PingSettings : TraceSettings {
    std::shared_ptr<const EchoModel> model;
    std::uint32_t stream = 0;  ///< names the sonar in every random draw
};

/// A sonar ready to ping: its configuration and everything that is derived from it.
struct Sonar {
    SonarConfig config;
    Pose T_vehicle_sensor;  ///< with a turning head at angle 0
    PingSettings settings;
    std::vector<double> range_edges_m;      ///< range_bins + 1
    std::vector<double> azimuth_edges_rad;  ///< fan only: beams + 1, from starboard (-) to port (+)
    std::vector<double> beam_azimuths_rad;  ///< fan only: azimuths of the beams' axes
    bool equal_azimuth = true;              ///< the beams of a fan are equal in azimuth
    /// The angles of a turning head about the sensor's z axis, positive to port; empty: fixed.
    std::vector<double> head_angles_rad;
    /// The profile of the water, for soundings; null: sound goes straight.
    std::shared_ptr<const SoundProfile> sound_profile;
    /// Its motion during a ping, by pose of the trajectory; null: it stands still.
    std::shared_ptr<const std::vector<PingMotion>> motions;

    /// The range of the middle of a bin.
    double middle_m(int bin) const { return 0.5 * (range_edges_m[bin] + range_edges_m[bin + 1]); }
};

/// The angle of the head at the pose with this index on the trajectory; 0 for a fixed sonar.
double head_angle_rad(const Sonar& sonar, std::uint32_t pose);

/// Finds the column of the image, from 0 on, of an azimuth. The sonar must outlive it.
class ColumnFinder {
  public:
    explicit ColumnFinder(const Sonar& sonar);
    double operator()(double azimuth_rad) const;

  private:
    const Sonar& sonar_;
    std::vector<double> sines_;  ///< sines of the beams' edges
};

/// T_world_sensor at that pose.
Pose sensor_pose(const Sonar& sonar, const Pose& T_world_vehicle, std::uint32_t pose);

/// The key of the random draws of a ping.
struct PingKey {
    std::uint64_t seed = 0;
    std::uint32_t ping = 0;  ///< index of the pose on the trajectory
};

/// Forms the image of a traced ping by the sonar's echo model, with the terms that are in both
/// `terms` and the settings. A pure function: the same arguments give the same bytes. `settings`
/// may differ from those of the trace except for the view. The counts and the times of the ping
/// include the trace; its multipath is counted only if it is in the image. A ping of several groups
/// of beams has their mean counts and the sum of their times.
Ping form_image(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                const PingKey& key, const Terms& terms = {});

}  // namespace sonarsim
