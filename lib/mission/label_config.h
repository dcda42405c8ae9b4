#pragma once

#include <string>
#include <vector>

#include "mission/place.h"

namespace sonarsim {

/// The classes that are background: they have neither contrast, shadow nor visible share.
struct LabelConfig {
    std::vector<std::string> background{"auto"};  ///< classes that are not objects
    MissionPlace place;

    bool operator==(const LabelConfig&) const = default;
};

}  // namespace sonarsim
