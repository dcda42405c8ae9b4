#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "simulate/sonar/kinds.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The distance from a sonar straight down to the scene, m. Nothing if no surface is below.
std::optional<double> altitude_m(const VisibilityEngine& engine, const Pose& T_world_sensor);

/// The measured values for the metadata of a ping: altitude_m() and the values of the sonar's kind.
/// An absent value is null; the result is null for kinds that measure nothing.
nlohmann::ordered_json measured(const PingView& view, const VisibilityEngine& engine);

}  // namespace sonarsim
