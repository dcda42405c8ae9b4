#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "mission/sonar_keys.h"
#include "ping/sonar.h"

namespace sonarsim {

/// What a ping becomes in the files that hold all pings of a sensor.
enum class RecordKind {
    none,
    waterfall,  ///< a row of port and starboard ranges
    echogram,   ///< a column of ranges
    soundings,  ///< a point per beam
    scan,       ///< a column of ranges at the angle of the head
};

/// A finished ping, and where the sonar was.
struct PingView {
    const Sonar& sonar;
    const Pose& T_world_vehicle;
    std::uint32_t pose;  ///< index on the trajectory
    const Ping& ping;
};

/// All that tells one kind of sonar from the others.
struct KindOfSonar {
    SonarKeys keys;  ///< its name, its defaults and the keys that a mission may set
    ViewShape shape;
    bool looks_down;         ///< the default mount: down with z along the bow, or forward
    double gain;             ///< m of Eq. 12
    bool range_noise_fades;  ///< whether late echoes are weaker, Eq. 8
    bool has_images;         ///< a ping is an image of its own: range by azimuth
    RecordKind record;
    /// Completes a sonar that common_sonar() has begun; null when nothing is left to do.
    void (*finish)(Sonar& sonar) = nullptr;
    /// Adds what the metadata of a ping say was measured, besides the altitude; null for a sonar
    /// whose metadata say nothing.
    void (*measure)(const PingView& view, nlohmann::ordered_json& json) = nullptr;
};

// One file each.
KindOfSonar imaging_kind();
KindOfSonar profiling_kind();
KindOfSonar sidescan_kind();
KindOfSonar echosounder_kind();
KindOfSonar scanning_kind();

/// Every kind, in the order in which messages name them.
const std::vector<KindOfSonar>& kinds_of_sonar();

const KindOfSonar& kind_of(SonarKind kind);

/// The kind's name in a mission.
std::string_view name_of(SonarKind kind);

/// A sonar of this kind as it is where the mission says nothing else.
SonarConfig default_sonar(SonarKind kind);

/// What load_mission() and resolved_yaml() need to know of the kinds.
SonarKeyTable sonar_keys();

}  // namespace sonarsim
