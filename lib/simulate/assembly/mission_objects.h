#pragma once

#include "input/mission/mission.h"
#include "input/mission/parse.h"
#include "input/mission/variants.h"
#include "input/scene/objects.h"
#include "input/scene/scene.h"

namespace sonarsim {

/// The classes that are never annotated, as SceneObjects::background: those that
/// `labels.background` names. `auto` is the classes of the bottom (bottom_patterns()) and, if there
/// are two classes or more, of the object with the largest surface at rest. The class `clutter` of
/// `scatter` is background, too. InputError for a name that no class and no scattered object has.
std::vector<std::uint8_t> background_classes(const Mission& mission, const Scene& scene,
                                             const SceneObjects& objects);

/// The classes whose masks include the shadow, as SceneObjects::shadow. InputError as above.
std::vector<std::uint8_t> shadow_classes(const Mission& mission, const SceneObjects& objects);

/// The class that `auto` makes background for its surface alone; nothing for a bottom. It may be
/// the object that a mission is about, such as the hull of a wreck of several parts.
std::optional<std::string> background_by_size(const Mission& mission, const Scene& scene,
                                              const SceneObjects& objects);

/// The objects and classes that any variant of a mission can have, in the order of the mission.
/// Objects of files are taken from `scene`; objects with a drawn number are named without any.
PossibleObjects possible_objects(const Mission& mission, const Scene& scene);

/// The variants of a mission, with the classes of all choices. May read the files of the scene.
Variants variants_of(const Mission& mission, const MissionSource& source);

}  // namespace sonarsim
