#pragma once

#include <functional>
#include <span>

#include "simulate/calibrated/speckle/scatterers.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// Finds the scatterers that lie on samples and hands them to `use`, a block at a time. In the
/// projection along the axis of the world that a sample faces most, every cell has one point, drawn
/// from its number and the key. The sample that covers the point holds the scatterer, so a surface
/// has the same scatterers however it is cut into samples. `shape`: that of the view.
void find_scatterers(std::span<const Sample> samples, ViewShape shape, const ScattererCells& cells,
                     const SonarInScene& sonar, PhiloxKey key, Scatterers& block,
                     const std::function<void(const Scatterers&)>& use);

}  // namespace sonarsim
