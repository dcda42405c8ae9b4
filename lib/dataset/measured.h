#pragma once

#include <nlohmann/json.hpp>

#include "ping/ping.h"
#include "sonar/sonar.h"
#include "visibility/engine.h"

namespace sonarsim {

/// What the metadata of a ping say was measured; null when imaging. All have the altitude, the
/// truth: how far below the sonar the scene begins. side-scan: the first bottom return on either
/// side. echosounder: the detected depth. profiling: how many soundings. What is absent is null.
nlohmann::ordered_json measured(const Sonar& sonar, const VisibilityEngine& engine,
                                const Pose& T_world_vehicle, const Ping& ping);

}  // namespace sonarsim
