#pragma once

#include <string>

#include "input/mission/mission.h"
#include "input/mission/sonar_keys.h"

namespace sonarsim {

/// The mission as YAML with all values. `parse_mission` reads it back to an equal Mission, from any
/// folder.
std::string resolved_yaml(const Mission& mission, SonarKeyTable sonars);

/// The mission for use on another machine: paths are relative to the folder of the scene file, and
/// there is no output folder.
Mission portable(const Mission& mission);

/// 32 hexadecimal digits that differ between missions with different images. The paths of files are
/// taken relative to the scene file, so that a dataset that is moved, or rendered on another
/// machine, has the same hash. The hash does not depend on the output folder and the contents of
/// files.
std::string mission_hash(const Mission& mission, SonarKeyTable sonars);

}  // namespace sonarsim
