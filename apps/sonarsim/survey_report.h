#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "assembly/assemble.h"
#include "checks/survey.h"
#include "checks/warning.h"

namespace sonarsim {

/// A sonar's survey as indented lines.
std::string survey_text(const SonarSurvey& found, const Scene& scene);

/// A sonar's survey as JSON.
nlohmann::ordered_json survey_json(const SonarSurvey& found, const Scene& scene);

/// The lines about the size of a dataset. `seconds` (NaN: unknown) and `bytes` are estimates.
std::string estimate_text(std::uint64_t pings, std::size_t images, double seconds, double set_up_s,
                          double bytes, double most_bytes);

nlohmann::ordered_json warnings_json(std::span<const Warning> warnings);

}  // namespace sonarsim
