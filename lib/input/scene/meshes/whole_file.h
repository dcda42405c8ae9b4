#pragma once

#include <string>
#include <string_view>

namespace sonarsim {

/// The relevant part of an STL: a binary one without the bytes that exporters leave behind its
/// triangles. InputError with the name of the file if it ends before its last triangle does.
std::string_view whole_stl(std::string_view bytes, const std::string& file);

/// InputError with the name of the file if a PLY has a faulty header or ends before the last of
/// its elements does. Libassimp reads past the end of such a file.
void require_whole_ply(std::string_view bytes, const std::string& file);

}  // namespace sonarsim
