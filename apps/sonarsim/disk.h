#pragma once

#include <filesystem>
#include <string>

namespace sonarsim {

/// InputError if nothing can be written to an output folder, or where it would be made.
void require_writable(const std::filesystem::path& output);

/// A size as text, "4.1 GB".
std::string size_text(double bytes);

}  // namespace sonarsim
