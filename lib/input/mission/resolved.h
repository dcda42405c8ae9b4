#pragma once

#include <string>
#include <string_view>

#include "input/mission/mission.h"
#include "input/mission/sonar_keys.h"

namespace sonarsim {

/// The mission as YAML with all values. `parse_mission` reads it to an equal one, from any folder.
std::string resolved_yaml(const Mission& mission, SonarKeyTable sonars);

/// The mission for another machine: paths relative to the scene file's folder, no output folder.
Mission portable(const Mission& mission);

/// 32 hexadecimal digits that differ between missions with different images. The paths of files are
/// taken relative to the scene file, so that a dataset that is moved, or rendered on another
/// machine, has the same hash. It does not depend on the output folder and what files hold.
std::string mission_hash(const Mission& mission, SonarKeyTable sonars);

/// The keys in which two missions differ, for messages: " (seed: 7 there, 8 here; and 2 more)",
/// with the first few of them. "" if they do not differ, or if one is not YAML.
std::string differing_keys(std::string_view there, std::string_view here);

}  // namespace sonarsim
