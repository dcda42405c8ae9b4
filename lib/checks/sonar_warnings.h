#pragma once

#include <vector>

#include "checks/survey.h"
#include "checks/warning.h"
#include "mission/mission.h"
#include "ping/sonar.h"

namespace sonarsim {

/// Doubts about what a sonar sees: blind pings and why they are, echoes below the noise, pictures
/// that are white or black.
std::vector<Warning> sonar_warnings(const OutputConfig& output, const Sonar& sonar,
                                    double full_scale, const SonarSurvey& found);

}  // namespace sonarsim
