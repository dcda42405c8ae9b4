#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "input/mission/document.h"

namespace sonarsim {

/// The folders of the presets that come with the program.
inline constexpr const char* sensor_presets = "sensors";
inline constexpr const char* seabed_presets = "seabeds";
inline constexpr const char* randomised_presets = "randomised";

/// The presets in one of these folders, as "oculus_m750d_750khz", sorted.
std::vector<std::string> shipped_presets(const std::string& kind = sensor_presets);

/// The end of a message about an unknown preset: the nearest name, and all. `name`: or a path.
std::string shipped_hint(std::string name, const std::string& kind = sensor_presets);

/// The file of a path from configs/ that came with the program; empty: none.
std::filesystem::path shipped_file(const std::filesystem::path& name);

/// The file that a preset's path means: below `base_folder`, or the program's. Empty: none.
std::filesystem::path preset_file(const std::filesystem::path& name,
                                  const std::filesystem::path& base_folder);

/// Replaces the items {preset: FILE, sensor: NAME} of the mission's list `vary` by the rules of the
/// file, whose keys are those of the sensor, or of the mission where no sensor is named.
void fill_in_rules(YamlNode& mission, const std::filesystem::path& base_folder);

/// Fills the sections `sensors.NAME` and `scene.seabed` with the keys of the file that their key
/// `preset` names, and removes that key. Keys that a section already has stay as they are. Relative
/// paths start at `base_folder`. InputError for a file that is unreadable or names a preset.
void fill_in_presets(YamlNode& mission, const std::filesystem::path& base_folder);

}  // namespace sonarsim
