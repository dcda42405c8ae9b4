#pragma once

#include <nlohmann/json_fwd.hpp>

#include "mission/sonar_keys.h"

namespace sonarsim {

/// The JSON Schema (2020-12) of a mission, with which editors complete and check missions. It is
/// made from the same description of the keys as the reader: type, limits, default, choices and
/// meaning of each key, the required keys, and the keys of each kind of sonar. A schema cannot
/// express checks across keys; they are in the `$comment` of their section.
nlohmann::ordered_json mission_json_schema(SonarKeyTable sonars);

}  // namespace sonarsim
