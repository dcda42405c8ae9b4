#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mission/mission.h"
#include "mission/sonar_keys.h"

namespace sonarsim {

/// What a mission is read from, as in load_mission.
struct MissionSource {
    std::filesystem::path file;
    std::filesystem::path base_folder;
    std::vector<std::string> overrides;
};

/// The variants of a mission: missions with the keys that `vary` names drawn, all but those that
/// are drawn for every ping, whose rules stay. The seed of each follows from that of the mission
/// and its index, and every draw from the seed, the place of its rule in `vary` and the index; so a
/// variant does not depend on how many there are. Each holds what was drawn as Mission::variant and
/// has a folder of its own in the mission's output folder. InputError at the place in `vary` for a
/// key or a value that the mission does not take.
std::vector<Mission> draw_variants(const Mission& mission, const MissionSource& source,
                                   SonarKeyTable sonars);

/// The name of a variant's folder, "variant_0017".
std::string variant_folder(int index);

}  // namespace sonarsim
