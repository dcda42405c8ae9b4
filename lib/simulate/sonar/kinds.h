#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "input/mission/sonar_keys.h"
#include "simulate/ping/sonar.h"
#include "simulate/sonar/record_shape.h"

namespace sonarsim {

/// A finished ping, and the pose of the vehicle.
struct PingView {
    const Sonar& sonar;
    const Pose& T_world_vehicle;
    std::uint32_t pose;  ///< index on the trajectory
    const Ping& ping;
};

/// The properties of one kind of sonar.
struct KindOfSonar {
    SonarKeys keys;  ///< its name, its defaults and the keys that a mission may set
    ViewShape shape;
    bool looks_down;         ///< the default mount: down with z along the bow, or forward
    double gain;             ///< m of Eq. 12
    bool range_noise_fades;  ///< echoes that range noise delays are weaker, Eq. 8
    bool has_images;         ///< a ping is an image: range by azimuth
    RecordShape record = {};
    /// Completes the sonar of common_sonar(); null if nothing is left to do.
    void (*finish)(Sonar& sonar) = nullptr;
    /// Adds the measured values of a ping to its metadata, in addition to the altitude; null for a
    /// sonar that measures nothing.
    void (*measure)(const PingView& view, nlohmann::ordered_json& json) = nullptr;
};

/// Every kind, in the order in which messages name them.
const std::vector<KindOfSonar>& kinds_of_sonar();

const KindOfSonar& kind_of(SonarKind kind);

/// The kind's name in a mission.
std::string_view name_of(SonarKind kind);

/// The defaults of a kind.
SonarConfig default_sonar(SonarKind kind);

/// The keys of all kinds, for load_mission() and resolved_yaml().
SonarKeyTable sonar_keys();

}  // namespace sonarsim
