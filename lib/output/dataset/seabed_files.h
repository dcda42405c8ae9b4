#pragma once

#include <string>
#include <utility>
#include <vector>

#include "input/scene/seabed/seabed.h"

namespace sonarsim {

// The true heights, materials and objects of a generated sea bed: the files in OUT/seabed/.

/// The names of these files, relative to the folder of a dataset.
std::vector<std::string> seabed_file_names();

/// Their bytes, by name.
std::vector<std::pair<std::string, std::string>> seabed_files(const Seabed& bed);

}  // namespace sonarsim
