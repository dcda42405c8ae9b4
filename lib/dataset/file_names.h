#pragma once

#include <cstdint>
#include <string>
#include <string_view>

// The names of files that a dataset tells of itself. A dataset may come from anybody, so that a
// name is checked before it becomes a path or a link.

namespace sonarsim {

/// Whether the text can name a file or a folder that lies in another one directly: letters of
/// ASCII, digits, '_', '-', '+' and '.', the first one no '.'.
bool is_plain_name(std::string_view text);

/// Whether the text is one or more plain names with '/' between them: "fls/waterfall.npy".
bool is_inner_path(std::string_view text);

/// Whether the text is an inner path once its only '%', in its last name, stands with a digit for
/// the length as "%06d": "fls/polar/%06d.npy".
bool is_pattern(std::string_view text);

/// "fls/polar/%06d.npy" with a number in it; empty for any text that is no pattern.
std::string numbered(const std::string& pattern, std::uint64_t number);

}  // namespace sonarsim
