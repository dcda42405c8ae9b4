#pragma once

#include "core/error.h"

namespace sonarsim {

/// The location of a section in the mission file, for messages. Two missions with the same content
/// are equal wherever it is written.
struct SourceLocation {
    Location location;

    bool operator==(const SourceLocation&) const { return true; }
};

}  // namespace sonarsim
