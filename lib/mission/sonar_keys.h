#pragma once

#include <span>
#include <string_view>

#include "mission/mission.h"

namespace sonarsim {

/// The keys of one kind of sonar in a mission. lib/sonar defines the kinds and depends on
/// lib/mission, so callers that read or write a mission pass the keys of the kinds.
struct SonarKeys {
    SonarKind kind;
    std::string_view name;
    SonarConfig defaults;

    // Keys that only some kinds have.
    bool azimuth = true;        ///< azimuth_deg
    bool elevation = true;      ///< elevation_deg
    bool opening = false;       ///< opening_deg
    bool azimuth_bins = false;  ///< azimuth_bins
    bool range_noise = true;    ///< noise.range_lambda_m may be above 0
    bool head = false;          ///< sector_deg and step_deg
};

/// All kinds, in the order in which messages name them.
using SonarKeyTable = std::span<const SonarKeys>;

}  // namespace sonarsim
