#pragma once

#include <array>
#include <string>

#include "mission/document.h"
#include "mission/limits.h"

namespace sonarsim {

// Values of a JSON file of another program, read as YAML. Functions throw InputError at the place
// of a wrong value; `name` is its name in the message.

[[noreturn]] void refuse_at(const YamlNode& node, const std::string& what);

/// `node`, which must be an object.
const YamlNode& map_at(const YamlNode& node, const std::string& name);

double number_in(const YamlNode& node, const std::string& name, const Limits& limits);
bool flag_in(const YamlNode& node, const std::string& name);
std::string text_in(const YamlNode& node, const std::string& name);

/// [x, y, z], or zeros where the object has no such key.
std::array<double, 3> vector_in(const YamlNode& object, const char* key, const Limits& limits);

}  // namespace sonarsim
