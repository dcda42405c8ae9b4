#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "visibility/engine.h"

namespace sonarsim {

/// The engine of a view.
struct EngineOfView {
    View view;
    double goal;  ///< the error goal that it is asked for
    std::shared_ptr<const VisibilityEngine> engine;
    /// The error of its images where a trial has found it, else NaN: they have the engine's own
    /// estimate.
    double error = std::numeric_limits<double>::quiet_NaN();
};

/// Traces each view by its own engine, and everything else by that of the other views.
std::unique_ptr<VisibilityEngine> make_engine_by_view(
    std::shared_ptr<const VisibilityEngine> of_others, std::vector<EngineOfView> views);

}  // namespace sonarsim
