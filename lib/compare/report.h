#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compare/compare.h"

namespace sonarsim {

/// The table of all figures for a terminal, the distances, the verdict and what to change first.
std::string comparison_text(const Comparison& comparison);

/// The same as compare.json.
nlohmann::ordered_json comparison_json(const Comparison& comparison);

/// The verdict in one or two sentences.
std::string verdict_text(const Comparison& comparison);

}  // namespace sonarsim
