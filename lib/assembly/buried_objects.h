#pragma once

#include <span>
#include <vector>

#include "mission/mission.h"
#include "ping/sonar.h"
#include "scene/placed_file.h"
#include "scene/scene.h"
#include "trace/buried.h"

namespace sonarsim {

/// The sediments of the sea beds of a scene, at the frequency of a sonar.
std::vector<SedimentPath> sediments_of(const Mission& mission, const Scene& scene,
                                       const Sonar& sonar);

/// Sets the buried objects of the scene's files in the sonars. Call find_targets() before.
/// InputError for an object that is too large.
void bury_objects(const Mission& mission, std::span<const PlacedFile> files, const Scene& scene,
                  std::span<Sonar> sonars);

}  // namespace sonarsim
