#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/pose.h"
#include "input/mission/mission.h"
#include "simulate/sonar/kinds.h"
#include "simulate/visibility/engine.h"
#include "simulate/visibility/make_engine.h"

namespace sonarsim {

// The steps of setting up a sonar that several kinds share.

/// `bins` + 1 equally spaced values from `low` to `high`, both exact.
std::vector<double> edges(double low, double high, int bins);

/// Sets T_vehicle_sensor: the default mount of the kind, turned by the mission's roll, pitch and
/// yaw and moved by its translation. Sonars that look down have x along the vehicle's -z and z
/// along its x, so that azimuth runs from starboard (-) to port (+).
void set_mount(Sonar& sonar, const KindOfSonar& kind);

/// A sonar with the mount, the view and the range edges of its configuration and its kind.
Sonar common_sonar(const SonarConfig& config, const AccuracyConfig& accuracy,
                   const KindOfSonar& kind);

/// The azimuth edges of a fan of equal beams.
void add_azimuth(Sonar& sonar);

/// The echo model that the sonar's configuration names. For the calibrated model it also sets the
/// azimuths of beams that are not equal in azimuth.
std::shared_ptr<const EchoModel> make_echo_model(Sonar& sonar, const KindOfSonar& kind,
                                                 const WaterConfig& water);

/// For metadata: an absent value is null.
nlohmann::ordered_json number_or_null(const std::optional<double>& value);

/// The settings of a mission's `engine` and `octree` keys. For `auto` see also
/// simulate/assembly/assemble.h.
EngineSettings engine_settings(EngineKind kind, const OctreeConfig& octree = {});
EngineSettings engine_settings(const Mission& mission);

/// The distance from a sonar straight down to the scene, m. Nothing if no surface is below.
std::optional<double> altitude_m(const VisibilityEngine& engine, const Pose& T_world_sensor);

/// The measured values for the metadata of a ping: altitude_m() and the values of the sonar's kind.
/// An absent value is null; the result is null for kinds that measure nothing.
nlohmann::ordered_json measured(const PingView& view, const VisibilityEngine& engine);

}  // namespace sonarsim
