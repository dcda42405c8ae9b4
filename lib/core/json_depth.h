#pragma once

#include <string_view>

namespace sonarsim {

/// True if arrays and objects of a JSON text are nested more than `levels` deep. Recursive
/// functions copy, compare and write a JSON tree, so a deep one exhausts the stack. The text need
/// not be valid JSON.
bool is_nested_deeper(std::string_view text, int levels);

}  // namespace sonarsim
