#pragma once

#include "simulate/calibrated/equation/patches.h"
#include "simulate/calibrated/model.h"
#include "simulate/trace/sample_kinds.h"

namespace sonarsim {

/// The shape of the view in which footprints of a kind taper; nothing: they are parallelograms.
inline std::optional<ViewShape> taper_shape(SampleKind kind, ViewShape shape) {
    return kind_of(kind).is_surface ? std::optional(shape) : std::nullopt;
}

/// Applies the sonar equation to pieces of samples, or to points, whose area is their cross-section
/// and which fill a resolution cell. Returns the number of echoes outside the range.
inline std::uint64_t find_echoes(bool are_points, const CalibratedModel& model,
                                 const Scattering& scattering, PatchBlock& pieces,
                                 PointEchoes& echoes) {
    if (!are_points) return apply_sonar_equation(pieces, scattering, model.equation, echoes);
    pieces.material.fill(0);
    pieces.half_range_m.fill(0.5F * model.target_cell.depth_m);
    pieces.half_sine.fill(0.5F * model.target_cell.sine);
    Scattering unit;
    unit.materials.emplace_back().lambert = 1.0F;
    return apply_sonar_equation(pieces, unit, model.equation, echoes);
}

}  // namespace sonarsim
