#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/pose.h"
#include "dataset/writer.h"

namespace sonarsim {

/// Position in metres; quaternion as x, y, z, w.
nlohmann::ordered_json describe_pose(const Pose& pose);

/// The drawn values by key; text if a value is neither a number nor a flag.
nlohmann::ordered_json describe_drawn(const DrawnValues& drawn);

/// The metadata of one ping.
nlohmann::ordered_json describe_ping(const Mission& mission, const Assembly& assembly,
                                     const FinishedPing& finished);

/// JSON as it is written: indented, with a line feed at the end.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace sonarsim
