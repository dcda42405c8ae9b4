#pragma once

#include <nlohmann/json.hpp>

namespace sonarsim {

/// The number to five digits, for people.
nlohmann::ordered_json short_number(double value);

}  // namespace sonarsim
