#pragma once

#include "core/error.h"

namespace sonarsim {

/// The place of a section in the mission file, for messages. All places compare equal, so that two
/// missions with the same content are equal.
struct MissionPlace {
    Location location;

    bool operator==(const MissionPlace&) const { return true; }
};

}  // namespace sonarsim
