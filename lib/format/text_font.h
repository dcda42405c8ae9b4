#pragma once

#include <filesystem>

namespace sonarsim {

/// The TrueType font of pictures for people. InputError, which names the package, if it is not
/// installed; `picture` is the one that needs it.
const char* text_font(const std::filesystem::path& picture);

}  // namespace sonarsim
