#pragma once

#include <string>
#include <string_view>

#include "core/error.h"

namespace sonarsim {

/// The next word behind blanks, and the next line without the blanks around it; "" at the end.
std::string_view take_word(std::string_view& text);
std::string_view take_line(std::string_view& text);

/// The stand-in for a blank in a name.
inline constexpr char blank_of_name = '\x1f';

/// The text of an OBJ or STL as libassimp reads it right. Normals and texture coordinates are left
/// out, and names have `blank_of_name`. InputError for a vertex that it would skip.
std::string mended_text(std::string_view text, const Location& file);

}  // namespace sonarsim
