#pragma once

#include <nlohmann/json_fwd.hpp>

#include "mission/sonar_keys.h"

namespace sonarsim {

/// The JSON Schema (2020-12) of a mission, from the same description of its keys as the reader:
/// type, limits, default, choices and meaning of each key, which keys are required, and which each
/// kind of sonar has. Checks across keys are in the `$comment` of their section: a schema cannot
/// tell them. Editors complete and check a mission with it.
nlohmann::ordered_json mission_json_schema(SonarKeyTable sonars);

}  // namespace sonarsim
