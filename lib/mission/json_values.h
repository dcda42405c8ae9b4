#pragma once

#include <array>
#include <string>

#include "mission/document.h"
#include "mission/limits.h"

namespace sonarsim {

// Values of a JSON file that another program wrote, read as YAML. InputError at the place of the
// value where it is not what it must be; `name` is what the message calls it.

[[noreturn]] void refuse_at(const YamlNode& node, const std::string& what);

/// `node`, which must be an object.
const YamlNode& map_at(const YamlNode& node, const std::string& name);

double number_in(const YamlNode& node, const std::string& name, const Limits& limits);
bool flag_in(const YamlNode& node, const std::string& name);
std::string text_in(const YamlNode& node, const std::string& name);

/// [x, y, z], or zeros where the object has no such key.
std::array<double, 3> vector_in(const YamlNode& object, const char* key, const Limits& limits);

}  // namespace sonarsim
