#pragma once

#include <string>
#include <string_view>

#include "core/error.h"

namespace sonarsim {

/// The next word behind blanks; "" at the end.
std::string_view take_word(std::string_view& text);

/// The text of an OBJ as libassimp reads it right. Normals and texture coordinates are left out.
/// InputError for a vertex that it would skip.
std::string mended_obj(std::string text, const Location& file);

}  // namespace sonarsim
