#pragma once

#include "assembly/assemble.h"
#include "mission/mission.h"
#include "visibility/make_engine.h"

namespace sonarsim {

/// The settings of a mission's engine. For `engine: auto` with views to choose by: every sonar of
/// the mission at a few poses spread over its trajectory, whatever part of it is rendered.
EngineSettings engine_settings(const Mission& mission, const Assembly& assembly);

}  // namespace sonarsim
