#pragma once

#include <nlohmann/json.hpp>

#include "sonar/kinds.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The measured values for the metadata of a ping: the true altitude, that is the distance from the
/// sonar straight down to the scene, and the values of the sonar's kind. An absent value is null;
/// the whole is null for kinds that measure nothing.
nlohmann::ordered_json measured(const PingView& view, const VisibilityEngine& engine);

}  // namespace sonarsim
