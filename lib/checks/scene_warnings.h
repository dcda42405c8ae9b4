#pragma once

#include <span>
#include <vector>

#include "assembly/assemble.h"
#include "checks/survey.h"
#include "checks/warning.h"

namespace sonarsim {

/// Doubts about the size of the scene and which way up it is, the water and the materials.
std::vector<Warning> scene_warnings(const Mission& mission, const Assembly& assembly,
                                    std::span<const SonarSurvey> sonars);

}  // namespace sonarsim
