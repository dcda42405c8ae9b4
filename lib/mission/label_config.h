#pragma once

#include <string>
#include <vector>

#include "mission/place.h"

namespace sonarsim {

/// What is an object and what background: background has neither contrast, shadow nor visible share.
struct LabelConfig {
    std::vector<std::string> background{"auto"};  ///< classes that are no objects
    MissionPlace place;

    bool operator==(const LabelConfig&) const = default;
};

}  // namespace sonarsim
