#pragma once

#include <string_view>

namespace sonarsim {

/// The format of a file by its first bytes, as "a .glb mesh", for messages about a file in the
/// wrong place; "" if it is unknown.
std::string_view known_format(std::string_view bytes);

}  // namespace sonarsim
