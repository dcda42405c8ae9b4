#pragma once

#include <string>
#include <string_view>

#include "mission/mission.h"
#include "mission/sonar_keys.h"

namespace sonarsim {

/// The mission as YAML with all values. `parse_mission` reads it back to an equal Mission, from any
/// folder.
std::string resolved_yaml(const Mission& mission, SonarKeyTable sonars);

/// Reads the text of resolved_yaml() for a portable mission whose files are not at hand. portable()
/// and mission_hash() of the result are those of the rendered mission. Its paths start at a made-up
/// folder, deep enough that no path climbs above the root, where a path would lose its "..". Throws
/// InputError as parse_mission() does.
Mission parse_resolved(std::string_view text, const std::string& file_name, SonarKeyTable sonars);

/// The mission for use on another machine: paths are relative to the folder of the scene file, and
/// there is no output folder.
Mission portable(const Mission& mission);

/// 32 hexadecimal digits that differ between missions with different images. The paths of files are
/// taken relative to the scene file, so that a dataset that is moved, or rendered on another
/// machine, has the same hash. The hash does not depend on the output folder and the contents of
/// files.
std::string mission_hash(const Mission& mission, SonarKeyTable sonars);

}  // namespace sonarsim
