#pragma once

#include "sonar/sonar.h"

namespace sonarsim {

/// A side-scan sonar (section IV): two beams, starboard and port, of range bins alone. No range
/// noise. Looks down.
Sonar make_sidescan(const SonarConfig& config, const AccuracyConfig& accuracy);

}  // namespace sonarsim
