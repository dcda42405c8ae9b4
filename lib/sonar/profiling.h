#pragma once

#include "sonar/sonar.h"

namespace sonarsim {

/// A multibeam profiling sonar (section V): an imaging sonar whose elevation is so narrow that it
/// makes one bin. Looks down.
Sonar make_profiling(const SonarConfig& config, const AccuracyConfig& accuracy);

}  // namespace sonarsim
