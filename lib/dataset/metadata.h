#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dataset/assemble.h"
#include "dataset/layout.h"
#include "mission/mission.h"

namespace sonarsim {

inline constexpr const char* dataset_format = "sonarsim dataset";
inline constexpr int dataset_format_version = 2;

/// dataset.json with `complete` set to false. Lengths in metres, angles in radians, edges from the
/// lowest bin to the highest: bin i lies between edges i and i + 1. `writers` by sensor.
nlohmann::ordered_json describe_dataset(const Mission& mission, const Assembly& assembly,
                                        const Layout& layout, const std::vector<Writers>& writers);

/// The metadata of one ping. Positions in metres; quaternions as x, y, z, w.
nlohmann::ordered_json describe_ping(const Mission& mission, const Assembly& assembly,
                                     const FinishedPing& finished);

/// JSON as it is written: indented, with a line feed at the end.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace sonarsim
