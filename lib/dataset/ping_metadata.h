#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "dataset/json.h"
#include "dataset/writer.h"

namespace sonarsim {

/// The drawn values by key; text if a value is neither a number nor a flag.
nlohmann::ordered_json describe_drawn(const DrawnValues& drawn);

/// The metadata of one ping.
nlohmann::ordered_json describe_ping(const Mission& mission, const Assembly& assembly,
                                     const FinishedPing& finished);

}  // namespace sonarsim
