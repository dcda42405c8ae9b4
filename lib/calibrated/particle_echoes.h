#pragma once

#include <cmath>
#include <span>

#include "calibrated/model.h"
#include "calibrated/patches.h"
#include "calibrated/speckle.h"
#include "core/elementary.h"

namespace sonarsim {

// The echoes of point targets in the water, section 5 of docs/calibrated.md. `Beams`: ArrayBeams or
// TransducerBeams.

/// Point targets: their area is their cross-section, and they face the sonar.
inline Scattering unit_scattering() {
    Scattering out;
    out.materials.emplace_back().lambert = 1.0F;
    return out;
}

/// Calls use(points, echoes) for blocks of point targets, all of the material 0.
template <class Beams, class Use>
void find_particles(const CalibratedModel& model, const Beams& beams,
                    std::span<const Sample> particles, PingCounts& counts, Use use) {
    const Scattering unit = unit_scattering();
    PatchBlock block;
    PointEchoes echoes;
    subdivide(particles, {}, {}, block, [&](PatchBlock& points) {
        points.material.fill(0);
        counts.echoes += points.count;
        counts.out_of_range += apply_sonar_equation(points, unit, model.equation, echoes);
        counts.out_of_range += find_columns(beams, points, echoes);
        use(points, echoes);
    });
}

/// Adds the amplitudes of point targets to a grid. A target keeps its own phase from ping to ping;
/// the phase of the path follows from the range.
template <class Beams>
void add_particle_amplitudes(const CalibratedModel& model, const Beams& beams,
                             const SeenParticles& particles, const PingDraws& draws,
                             PingCounts& counts, EchoGrid& grid) {
    const PhiloxKey key = draws.of_scene(stream_named("particles"));
    Amplitudes amplitudes;
    const double turns_per_m = 2.0 / model.wavelength_m;
    find_particles(model, beams, particles.samples, counts,
                   [&](const PatchBlock& points, const PointEchoes& echoes) {
                       for (int k = 0; k < points.count; ++k) {
                           const PhiloxBlock words =
                               philox({particles.numbers[points.sample[k]], 0, 0, 0}, key);
                           const double way = turns_per_m * static_cast<double>(echoes.range_m[k]);
                           const auto turns = static_cast<float>(way - std::floor(way));
                           const SinCosFloat phase = sincos_turns(unit_float(words.x0) + turns);
                           const float amplitude = std::sqrt(echoes.power[k]);
                           amplitudes.re[k] = amplitude * phase.cos;
                           amplitudes.im[k] = amplitude * phase.sin;
                       }
                       // Echoes up to a whole vector are added, too.
                       for (int k = points.count; k < echoes.count; ++k)
                           amplitudes.re[k] = amplitudes.im[k] = 0.0F;
                       add_amplitudes(beams, points, echoes, amplitudes, grid);
                   });
}

template <class Beams>
void add_particle_powers(const CalibratedModel& model, const Beams& beams,
                         const SeenParticles& particles, PingCounts& counts, EchoGrid& grid) {
    find_particles(model, beams, particles.samples, counts,
                   [&](const PatchBlock& points, const PointEchoes& echoes) {
                       add_powers(beams, points, echoes, grid);
                   });
}

}  // namespace sonarsim
