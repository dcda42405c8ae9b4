#pragma once

#include <string>
#include <string_view>

#include "mission/mission.h"
#include "mission/sonar_keys.h"

namespace sonarsim {

/// The mission as YAML with every value written out. `parse_mission` reads it back to an equal
/// Mission, from any folder.
std::string resolved_yaml(const Mission& mission, SonarKeyTable sonars);

/// Reads what resolved_yaml() made of a portable mission whose files are not at hand. portable()
/// and mission_hash() of the result are those of the mission that was rendered: its paths start at
/// a made-up folder which lies so deep that none of them climbs above the root, where a path would
/// lose its "..". InputError as of parse_mission().
Mission parse_resolved(std::string_view text, const std::string& file_name, SonarKeyTable sonars);

/// The mission as it can go to another machine: its paths start at the folder of the scene file,
/// and it has no output folder.
Mission portable(const Mission& mission);

/// 32 hexadecimal digits that differ when what is to be rendered differs. Neither the output folder
/// counts nor where the mission's files lie as a whole, only where they lie relative to the scene
/// file: a dataset moved or rendered on another machine is the same mission. What the files contain
/// does not count either.
std::string mission_hash(const Mission& mission, SonarKeyTable sonars);

}  // namespace sonarsim
