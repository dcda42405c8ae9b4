#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "input/mission/document.h"

namespace sonarsim {

/// Applies one `--set a.b.c=value` to the document of a mission. The path consists of
/// keys, and of indices (from 0) into lists. Missing sections are created, missing list items are
/// not. The value is YAML and replaces the old one, even a whole section. Its place is
/// "--set a.b.c=value", so that later messages name the override. Throws InputError when the path
/// or the value cannot be read, or when the path leads through a value that is not a section.
void apply_override(YamlNode& root, const std::string& setting);

/// Sets the value at the path "a.b.c" in the same way. The value is YAML text; `where` becomes the
/// place of the value and of all its parts.
void set_text(YamlNode& root, std::string_view path, const std::string& value,
              const Location& where);

/// The number at the path "a.b.c"; none where the document has no number there.
std::optional<double> number_at(const YamlNode& root, std::string_view path);

/// Removes a key of a map, if it is there.
void erase_key(YamlNode& map, std::string_view key);

}  // namespace sonarsim
