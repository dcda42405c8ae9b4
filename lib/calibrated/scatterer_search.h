#pragma once

#include <functional>
#include <span>

#include "calibrated/scatterers.h"
#include "visibility/engine.h"

namespace sonarsim {

/// Finds the scatterers that lie on samples and hands them to `use`, a block at a time. Seen along
/// the axis of the world that a sample faces most, every cell has one point, by its number and the
/// key; whichever sample covers it there holds the scatterer. However a surface is cut into
/// samples, it holds the same ones.
void find_scatterers(std::span<const Sample> samples, const ScattererCells& cells,
                     const SonarInScene& sonar, PhiloxKey key, Scatterers& block,
                     const std::function<void(const Scatterers&)>& use);

}  // namespace sonarsim
