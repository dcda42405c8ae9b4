#pragma once

#include <span>
#include <vector>

#include "core/random.h"
#include "simulate/calibrated/equation/bottom.h"
#include "simulate/calibrated/equation/patches.h"

namespace sonarsim {

/// Points with amplitudes. Their areas are cross-sections, and they face the sonar.
struct PointScatterers {
    std::vector<Sample> points;
    std::vector<float> turns;  ///< the phase of each of its own, in turns
};

/// Joins the pieces of targets to scatterers, each with one phase.
///
/// The pieces of one smooth surface of a target that lie within a cell make one scatterer. The
/// cells are counted from the middle of the highlight, where facets face the sonar. So a highlight
/// smaller than a cell is one scatterer, at its place, with the highlight's energy, and does not
/// flicker as the sonar moves. The scatterers of a larger highlight, and those of other surface,
/// have exponential strengths; the transition is gradual. A scatterer keeps its phase and its draw
/// from ping to ping.
///
/// `pieces`: surface after surface. `cell`: its size.
PointScatterers join_targets(std::span<const Sample> pieces, ViewShape shape,
                             const PointLimits& cell, const Scattering& scattering, PhiloxKey key);

}  // namespace sonarsim
