#pragma once

#include <cstdint>
#include <string>
#include <string_view>

// Names of files in a dataset.json. A dataset may come from anybody, so that a name is checked
// before it becomes a path or a link.

namespace sonarsim {

/// True if the text can name a file or a folder that lies in another one directly: letters of
/// ASCII, digits, '_', '-', '+' and '.', the first one no '.'.
bool is_plain_name(std::string_view text);

/// True if the text is one or more plain names with '/' between them: "fls/waterfall.npy".
bool is_inner_path(std::string_view text);

/// True if the text is an inner path with one number in its last name, "%06d" with any digit in
/// place of the 6: "fls/polar/%06d.npy".
bool is_pattern(std::string_view text);

/// "fls/polar/%06d.npy" with a number in it; empty for any text that is no pattern.
std::string numbered(const std::string& pattern, std::uint64_t number);

}  // namespace sonarsim
