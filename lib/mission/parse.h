#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "mission/document.h"
#include "mission/mission.h"
#include "mission/sonar_keys.h"

namespace sonarsim {

/// Reads and checks a mission, at most 1 MiB of strict YAML. Paths become absolute and normalised;
/// relative ones start at the folder of the mission file. A mission without a name bears that of
/// its file; one without an output folder writes to out/<name> below the current directory.
/// `overrides` are settings "a.b.c=value" that replace or add keys, the last one winning, under the
/// same checks and with the same meaning. InputError with file:line:column, or with the override,
/// for whatever is not exactly right. `sonars` are the kinds of sonar that a mission may name:
/// sonar_keys() of sonar/kinds.h.
Mission load_mission(const std::filesystem::path& file, std::span<const std::string> overrides,
                     SonarKeyTable sonars);

/// The same with relative paths that start at `base_folder`.
Mission load_mission(const std::filesystem::path& file, const std::filesystem::path& base_folder,
                     std::span<const std::string> overrides, SonarKeyTable sonars);

/// The same for a mission in memory. `file_name` is used in messages and for the default name.
Mission parse_mission(std::string_view text, const std::string& file_name,
                      const std::filesystem::path& base_folder,
                      std::span<const std::string> overrides, SonarKeyTable sonars);

/// The document of a mission's file with the overrides, nothing of it looked at yet.
YamlNode read_mission_document(const std::filesystem::path& file,
                               std::span<const std::string> overrides);

/// The mission that a document says. `file_name` is used for the default name.
Mission parse_mission(const YamlNode& root, const std::string& file_name,
                      const std::filesystem::path& base_folder, SonarKeyTable sonars);

}  // namespace sonarsim
