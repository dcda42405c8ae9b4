#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <string>

#include "input/mission/seabed_keys.h"
#include "input/scene/placed_file.h"
#include "input/scene/seabed/seabed.h"

namespace sonarsim {

/// The rule of a mission's seabed, without the window that is made.
SeabedRule rule_of(const SeabedConfig& config, std::uint64_t seed);

/// The placed seabed of a mission, made above `needed`, world x and y. `announce` gets a sentence
/// before a large one is made; it may be null.
PlacedFile seabed_of(const SeabedConfig& config, std::uint64_t seed,
                     const Eigen::AlignedBox2d& needed,
                     const std::function<void(const std::string&)>& announce);

}  // namespace sonarsim
