#pragma once

#include <span>

#include "mission/mission.h"
#include "ping/sonar.h"
#include "scene/scene.h"

namespace sonarsim {

/// The profile of sound speed of a mission's water, in the world. InputError for a file that cannot
/// be read.
SoundProfile sound_profile(const SoundProfileConfig& config, const Mission& mission);

/// Gives the scene its profile of sound speed, and the sonars that by which they make soundings.
/// InputError where the mission has something that goes straight.
void add_sound_profiles(const Mission& mission, Scene& scene, std::span<Sonar> sonars);

/// The engine alone samples small and smooth objects in water that bends sound. Adds a warning to
/// the scene if that loses the coherent echo of smooth faces.
void warn_of_lost_glints(std::span<const Sonar> sonars, Scene& scene);

}  // namespace sonarsim
