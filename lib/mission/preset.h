#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mission/document.h"

namespace sonarsim {

/// The presets that come with the program, as "oculus_m750d_750khz", sorted.
std::vector<std::string> shipped_presets();

/// The end of a message about an unknown preset: the nearest name, and all of them. `name` may be
/// a path.
std::string shipped_hint(std::string name);

/// Fills the sections `sensors.NAME` with the keys of the files that `sensors.NAME.preset` names,
/// and removes the key `preset`. Keys that a section already has stay as they are. Relative paths
/// start at `base_folder`. InputError for a file that cannot be read, is no section or names a
/// preset itself.
void fill_in_presets(YamlNode& mission, const std::filesystem::path& base_folder);

}  // namespace sonarsim
