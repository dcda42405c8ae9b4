#pragma once

#include "sonar/sonar.h"

namespace sonarsim {

/// An echosounder (section VI): one beam, a cone of half-angle opening / 2. Its range noise does
/// not fade. Looks down.
Sonar make_echosounder(const SonarConfig& config, const AccuracyConfig& accuracy);

}  // namespace sonarsim
