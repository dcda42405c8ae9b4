#pragma once

#include "input/mission/limits.h"

namespace sonarsim {

/// The model that turns the visible surface into an image: docs/model.md or docs/calibrated.md.
enum class ModelKind { paper, calibrated };

/// The models by name; the first is the default.
inline constexpr Choice<ModelKind> echo_models[]{{"paper", ModelKind::paper},
                                                 {"calibrated", ModelKind::calibrated}};

}  // namespace sonarsim
