#pragma once

#include <cstdint>
#include <vector>

#include "mission/mission.h"
#include "scene/objects.h"
#include "scene/scene.h"

namespace sonarsim {

/// The classes that are never annotated, as SceneObjects::background: those that
/// `labels.background` names. `auto` is the classes of the nodes that scene.bottom names and that
/// of the object with the largest surface at rest, if there is another class. InputError for a name
/// that no class has.
std::vector<std::uint8_t> background_classes(const Mission& mission, const Scene& scene,
                                             const SceneObjects& objects);

}  // namespace sonarsim
