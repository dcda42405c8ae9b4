#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "visibility/engine.h"

namespace sonarsim {

/// The engine of a view.
struct EngineOfView {
    View view;
    double goal;  ///< its error goal
    std::shared_ptr<const VisibilityEngine> engine;
    /// The error of its images if a trial has found it; NaN: the engine's own estimate is used.
    double error = std::numeric_limits<double>::quiet_NaN();
};

/// Traces each of `views` with its own engine, and other views and rays with `of_others`.
std::unique_ptr<VisibilityEngine> make_engine_by_view(
    std::shared_ptr<const VisibilityEngine> of_others, std::vector<EngineOfView> views);

}  // namespace sonarsim
