#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "assembly/assemble.h"
#include "survey/survey.h"
#include "survey/warning.h"

namespace sonarsim {

/// What a sonar saw in a survey, as lines that begin with blanks.
std::string survey_text(const SonarSurvey& found, const Scene& scene);

/// The same for programs.
nlohmann::ordered_json survey_json(const SonarSurvey& found, const Scene& scene);

nlohmann::ordered_json warnings_json(std::span<const Warning> warnings);

}  // namespace sonarsim
