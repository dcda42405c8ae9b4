#pragma once

#include <span>
#include <string_view>

#include "mission/mission.h"

namespace sonarsim {

/// What a mission says of one kind of sonar. The kinds themselves are in lib/sonar, which a mission
/// knows nothing of: whoever reads or writes one hands their keys in.
struct SonarKeys {
    SonarKind kind;
    std::string_view name;
    SonarConfig defaults;

    // The keys that not every kind has.
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
