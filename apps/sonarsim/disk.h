#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "checks/warning.h"

namespace sonarsim {

/// InputError if nothing can be written to an output folder, or where it would be made.
void require_writable(const std::filesystem::path& output);

/// A size as text, "4.1 GB".
std::string size_text(double bytes);

/// W34 if a dataset of `bytes` does not fit on the disk of its folder.
std::vector<Warning> disk_warnings_at(const std::filesystem::path& folder, double bytes);

}  // namespace sonarsim
