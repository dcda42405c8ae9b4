#pragma once

#include <array>

#include "mission/limits.h"

namespace sonarsim {

/// The model that turns the visible surface into an image: docs/model.md or docs/calibrated.md.
enum class ModelKind { paper, calibrated };

/// The models by name; the first is the default.
inline constexpr std::array echo_models{Choice<ModelKind>{"paper", ModelKind::paper},
                                        Choice<ModelKind>{"calibrated", ModelKind::calibrated}};

}  // namespace sonarsim
