#pragma once

#include <string>
#include <string_view>

#include "mission/mission.h"

namespace sonarsim {

/// The mission as YAML with every value written out. `parse_mission` reads it back to an equal
/// Mission, from any folder.
std::string resolved_yaml(const Mission& mission);

/// 32 hexadecimal digits that differ when what is to be rendered differs. Neither the output folder
/// counts nor where the mission's files lie as a whole, only where they lie relative to the scene
/// file: a dataset moved or rendered on another machine is the same mission. What the files contain
/// does not count either.
std::string mission_hash(const Mission& mission);

/// FNV-1a of 128 bits, as 32 hexadecimal digits. It tells inputs apart and stops no forger.
std::string fnv1a_128(std::string_view bytes);

}  // namespace sonarsim
