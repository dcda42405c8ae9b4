#pragma once

#include <string>
#include <vector>

#include "input/mission/mission.h"
#include "input/mission/parse.h"
#include "input/mission/sonar_keys.h"

namespace sonarsim {

/// Draws the variants of a mission: missions with the keys of `vary` drawn. Rules that are drawn
/// for every ping are kept. The seed of a variant is a function of the mission's seed and the
/// variant's index. A draw is a function of the seed, the index of its rule in `vary` and the
/// variant's index. Thus a variant does not depend on the number of variants. Mission::variant
/// holds the drawn values. Each variant has a folder of its own in the mission's output folder.
/// Throws InputError at the place in `vary` for a key or a value that the mission does not accept.
std::vector<Mission> draw_variants(const Mission& mission, const MissionSource& source,
                                   SonarKeyTable sonars);

/// Missions that show which objects the variants may have: the first variant with each choice, and
/// with each largest whole number, of the rules that vary the scene or the classes.
std::vector<Mission> extreme_variants(const Mission& mission, const MissionSource& source,
                                      SonarKeyTable sonars);

/// The name of a variant's folder, "variant_0017".
std::string variant_folder(int index);

}  // namespace sonarsim
