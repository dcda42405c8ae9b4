#pragma once

#include <string>
#include <vector>

#include "assembly/assemble.h"
#include "benchmark/setting.h"
#include "visibility/make_engine.h"

namespace sonarsim {

/// The settings of a report: rays and slices by error goal, the octree and the literal octree by
/// leaf size, each from coarse to fine, and `auto` at the mission's goal. Leaves finer than a
/// quarter of the finest range bin are omitted: they cost much and improve nothing. The mission's
/// own setting is included and marked.
std::vector<Setting> make_settings(const Mission& mission, bool quick);

/// The settings to make the engine of a setting with.
EngineSettings engine_settings(const Setting& setting, const Mission& mission,
                               const Assembly& assembly);

/// The error message of a mission with this setting, if the engine does not support the scene or a
/// view of its sonars; empty otherwise.
std::string unsupported(const Setting& setting, const Assembly& assembly);

}  // namespace sonarsim
