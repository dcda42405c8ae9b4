#pragma once

#include <memory>

#include "input/mission/mission.h"
#include "simulate/assembly/assemble.h"
#include "simulate/visibility/make_engine.h"

namespace sonarsim {

/// The settings of a mission's engine. For `engine: auto` they hold the views that rays trace.
EngineSettings engine_settings(const Mission& mission, const Assembly& assembly);

/// The engine of a mission, over the trees that its assembly has made. The assembly must outlive
/// it.
std::unique_ptr<VisibilityEngine> make_engine(const Mission& mission, const Assembly& assembly);

}  // namespace sonarsim
