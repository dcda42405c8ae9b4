#pragma once

#include <vector>

#include "input/mission/mission.h"
#include "input/mission/parse.h"
#include "input/scene/objects.h"

namespace sonarsim {

/// The objects and classes that any variant of a mission can have, in the order of the mission.
/// Objects of files are taken from `scene`; objects whose number is drawn are named even if the
/// scene has none.
PossibleObjects possible_objects(const Mission& mission, const Scene& scene);

/// Draws the variants of a mission, as draw_variants(), and notes in each of them the classes of
/// all choices. Reads the files of the scene if `vary` changes the scene or the classes.
std::vector<Mission> variants_of(const Mission& mission, const MissionSource& source);

}  // namespace sonarsim
