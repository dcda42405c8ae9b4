#pragma once

#include <string>
#include <string_view>

#include "mission/document.h"

namespace sonarsim {

/// Applies one `--set a.b.c=value` to the document of a mission. The path goes by keys, and by
/// index (from 0) into lists; sections that the document lacks are made, list items are not. The
/// value is YAML and replaces what was there, whole sections included. What it sets stands at the
/// place "--set a.b.c=value", so that every later check names the override. InputError when the
/// path or the value cannot be read, or when the path runs through something that is no section.
void apply_override(YamlNode& root, const std::string& setting);

/// Puts a value where the path "a.b.c" leads, in the same way. `where` is for what is wrong with
/// the path.
void set_key(YamlNode& root, std::string_view path, YamlNode value, const Location& where);

/// The same with a value that is YAML text and stands, with all that is in it, at `where`.
void set_text(YamlNode& root, std::string_view path, const std::string& value,
              const Location& where);

/// Removes a key of a map, if it is there.
void erase_key(YamlNode& map, std::string_view key);

}  // namespace sonarsim
