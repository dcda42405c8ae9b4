#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "sonar/kinds.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The distance from a sonar straight down to the scene, m; nothing if there is nothing below.
std::optional<double> altitude_m(const VisibilityEngine& engine, const Pose& T_world_sensor);

/// What the metadata of a ping say was measured: the altitude, which is the truth (how far below
/// the sonar the scene begins), and what the kind of sonar adds. What is absent is null; the whole
/// is null for kinds that measure nothing.
nlohmann::ordered_json measured(const PingView& view, const VisibilityEngine& engine);

}  // namespace sonarsim
