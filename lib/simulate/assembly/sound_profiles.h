#pragma once

#include <span>

#include "input/mission/mission.h"
#include "input/scene/scene.h"
#include "simulate/ping/sonar.h"

namespace sonarsim {

/// The profile of sound speed of a mission that has one, in the world. InputError for its file.
SoundProfile sound_profile(const Mission& mission);

/// Sets the profile of sound speed of the scene and of the sonars, for soundings.
/// InputError if the mission has a key that requires straight paths of sound.
void add_sound_profiles(const Mission& mission, Scene& scene, std::span<Sonar> sonars);

}  // namespace sonarsim
