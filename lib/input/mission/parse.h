#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "input/mission/document.h"
#include "input/mission/mission.h"
#include "input/mission/sonar_keys.h"

namespace sonarsim {

/// The source of a mission: a file, or its text in memory.
struct MissionSource {
    std::filesystem::path file;         ///< in memory the name for messages
    std::filesystem::path base_folder;  ///< relative paths of the mission start here
    std::vector<std::string> overrides = {};
    std::optional<std::string> text = {};  ///< in memory; its lines are not in messages
};

/// Reads and checks a mission, at most 1 MiB of strict YAML. Paths become absolute and normalised;
/// relative ones start at the base folder. A mission without a name gets the name of its file, one
/// without an output folder gets out/<name> below the current directory. `overrides` are settings
/// "a.b.c=value" that replace or add keys; the last one wins. `sonars` are the kinds of sonar that
/// a mission may name: sonar_keys() of simulate/sonar/kinds.h. Throws InputError with
/// file:line:column, or with the override, for anything wrong; also for the mission of a dataset if
/// `base_folder` is the folder of the dataset and the files of the scene are not there.
Mission load_mission(const MissionSource& source, SonarKeyTable sonars);

/// The same for a mission in memory. `file_name` is for messages and for the default name.
Mission parse_mission(std::string_view text, const std::string& file_name,
                      const std::filesystem::path& base_folder,
                      std::span<const std::string> overrides, SonarKeyTable sonars);

/// Reads the document of a mission and applies the overrides. Checks nothing else.
YamlNode read_mission_document(const MissionSource& source);

/// Reads the mission in a document. `file_name` is for the default name.
Mission parse_mission(const YamlNode& root, const std::string& file_name,
                      const std::filesystem::path& base_folder, SonarKeyTable sonars);

/// Applies one `--set a.b.c=value` to the document of a mission. The path consists of
/// keys, and of indices (from 0) into lists. Missing sections are created, missing list items are
/// not. The value is YAML and replaces the old one, even a whole section. Its place is
/// "--set a.b.c=value", so that later messages name the override. Throws InputError when the path
/// or the value cannot be read, or when the path leads through a value that is not a section.
void apply_override(YamlNode& root, const std::string& setting);

/// True if the setting fixes a key: it sets the key, or a section around it.
bool is_fixed_by(std::string_view key, std::string_view setting);

/// Sets the value at the path "a.b.c" in the same way, from YAML text; `where` becomes its place.
void set_text(YamlNode& root, std::string_view path, const std::string& value,
              const Location& where);

/// The number at the path "a.b.c"; none where the document has no number there.
std::optional<double> number_at(const YamlNode& root, std::string_view path);

}  // namespace sonarsim
