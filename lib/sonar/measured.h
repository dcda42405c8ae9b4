#pragma once

#include <nlohmann/json.hpp>

#include "sonar/kinds.h"
#include "visibility/engine.h"

namespace sonarsim {

/// What the metadata of a ping say was measured: the altitude, which is the truth (how far below
/// the sonar the scene begins), and what the kind of sonar adds. What is absent is null; the whole
/// is null for kinds that measure nothing.
nlohmann::ordered_json measured(const PingView& view, const VisibilityEngine& engine);

}  // namespace sonarsim
