#pragma once

#include <span>
#include <string>
#include <vector>

#include "assembly/assemble.h"
#include "dataset/sensor_summary.h"
#include "mission/mission.h"

namespace sonarsim {

/// Why images are black, nearly black or white where nobody may have meant them to be: a sentence
/// for each cause, with the figures and the likely cure. `sensors` are in the order of
/// Mission::sensors; one without pings is not judged. Empty when all is well.
std::vector<std::string> image_warnings(const Mission& mission, const Assembly& assembly,
                                        std::span<const SensorSummary> sensors);

}  // namespace sonarsim
