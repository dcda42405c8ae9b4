#pragma once

#include <filesystem>

#include "input/mission/document.h"
#include "input/mission/mission.h"

namespace sonarsim {

/// Appends `scene.clutter` to `scene.scatter` as a rule, and gives each rule that has `stock` the
/// `files` of these kinds, which scripts/make_scenes.py makes. `errors` gets the unknown kinds, and
/// the first whose files are not there. Relative paths start at `base_folder`.
void fill_in_stock(YamlNode& mission, const std::filesystem::path& base_folder, ErrorList& errors);

/// Gives each rule of `scene.scatter` without an area that of the scene, or all of a seabed with an
/// end; one on a mesh keeps none, which is all of the mesh. Densities become counts. InputError at
/// the place of a rule whose area is unknown.
void complete_scatter(SceneConfig& scene);

}  // namespace sonarsim
