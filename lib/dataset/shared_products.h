#pragma once

#include <string>
#include <vector>

#include "mission/mission.h"

namespace sonarsim {

/// The files of a dataset that belong to no single sonar, relative to its folder. They are written
/// before the first ping: those of a generated sea bed, and the reported poses.
std::vector<std::string> shared_products(const Mission& mission);

}  // namespace sonarsim
