#pragma once

#include <span>
#include <vector>

#include "assembly/assemble.h"
#include "checks/survey.h"
#include "checks/warning.h"

namespace sonarsim {

/// What may be wrong with a mission that is valid, by what it says and by what its sonars saw.
/// `sonars` are by Mission::sensors.
std::vector<Warning> find_warnings(const Mission& mission, const Assembly& assembly,
                                   std::span<const SonarSurvey> sonars,
                                   const VisibilityEngine& rays);

}  // namespace sonarsim
