#pragma once

#include <string_view>

namespace sonarsim {

/// Whether arrays and objects of a JSON text stand in one another more than `levels` deep. A tree
/// of JSON is copied, compared and written by functions that call themselves, so a deep one takes
/// all of the stack. The text need not be sound JSON.
bool is_nested_deeper(std::string_view text, int levels);

}  // namespace sonarsim
