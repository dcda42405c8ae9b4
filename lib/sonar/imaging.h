#pragma once

#include "sonar/sonar.h"

namespace sonarsim {

/// A multibeam imaging sonar (section III): range by azimuth, elevation is lost. Looks forward.
Sonar make_imaging(const SonarConfig& config, const AccuracyConfig& accuracy);

}  // namespace sonarsim
