#pragma once

#include <span>
#include <vector>

#include "assembly/assemble.h"
#include "checks/survey.h"
#include "checks/warning.h"

namespace sonarsim {

/// A doubt for the objects that no sonar of the mission sees: those that the mission places or
/// gives a class. One that the survey did not meet is looked for in the pings that have it in view.
std::vector<Warning> unseen_objects(const Mission& mission, const Assembly& assembly,
                                    std::span<const SonarSurvey> sonars,
                                    const VisibilityEngine& rays);

}  // namespace sonarsim
