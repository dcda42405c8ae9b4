#pragma once

#include <filesystem>

#include "mission/document.h"

namespace sonarsim {

/// Puts what the files of `sensors.NAME.preset` say into these sections, key by key, and takes the
/// key `preset` away. Keys that a section has already stay as they are. Relative paths start at
/// `base_folder`. InputError for a file that cannot be read, is no section or names a preset
/// itself.
void fill_in_presets(YamlNode& mission, const std::filesystem::path& base_folder);

}  // namespace sonarsim
