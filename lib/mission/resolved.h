#pragma once

#include <string>

#include "mission/mission.h"
#include "mission/sonar_keys.h"

namespace sonarsim {

/// The mission as YAML with every value written out. `parse_mission` reads it back to an equal
/// Mission, from any folder.
std::string resolved_yaml(const Mission& mission, SonarKeyTable sonars);

/// The mission as it can go to another machine: its paths start at the folder of the scene file,
/// and it has no output folder.
Mission portable(const Mission& mission);

/// 32 hexadecimal digits that differ when what is to be rendered differs. Neither the output folder
/// counts nor where the mission's files lie as a whole, only where they lie relative to the scene
/// file: a dataset moved or rendered on another machine is the same mission. What the files contain
/// does not count either.
std::string mission_hash(const Mission& mission, SonarKeyTable sonars);

}  // namespace sonarsim
