#pragma once

#include "core/error.h"

namespace sonarsim {

/// Where a piece of a mission stands, for messages. What two missions say is equal wherever it
/// stands.
struct Place {
    Location location;

    bool operator==(const Place&) const { return true; }
};

}  // namespace sonarsim
