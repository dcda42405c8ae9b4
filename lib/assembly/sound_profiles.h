#pragma once

#include <span>

#include "mission/mission.h"
#include "ping/sonar.h"
#include "scene/scene.h"

namespace sonarsim {

/// The profile of sound speed of a mission's water, which has one, in the world. InputError for a
/// file that cannot be read.
SoundProfile sound_profile(const Mission& mission);

/// Sets the profile of sound speed of the scene and of the sonars, for soundings.
/// InputError if the mission has a key that requires straight paths of sound.
void add_sound_profiles(const Mission& mission, Scene& scene, std::span<Sonar> sonars);

/// Adds a warning to the scene if the coherent echo of smooth faces is lost: where sound bends,
/// only the engine samples small and smooth objects.
void warn_of_lost_glints(std::span<const Sonar> sonars, Scene& scene);

}  // namespace sonarsim
