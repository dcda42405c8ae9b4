#pragma once

#include <cmath>
#include <span>

#include "core/elementary.h"
#include "simulate/calibrated/model.h"
#include "simulate/calibrated/patches.h"
#include "simulate/calibrated/speckle.h"
#include "simulate/calibrated/target_scatterers.h"

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

/// Adds the amplitudes of points to a grid. The phase of the path follows from the range.
template <class Beams>
void add_point_amplitudes(const CalibratedModel& model, const Beams& beams,
                          const PointScatterers& scatterers, PingCounts& counts, EchoGrid& grid) {
    Amplitudes amplitudes;
    const double turns_per_m = 2.0 / model.wavelength_m;
    find_particles(model, beams, scatterers.points, counts,
                   [&](const PatchBlock& points, const PointEchoes& echoes) {
                       for (int k = 0; k < points.count; ++k) {
                           const double way = turns_per_m * static_cast<double>(echoes.range_m[k]);
                           const auto turns = static_cast<float>(way - std::floor(way));
                           const SinCosFloat phase =
                               sincos_turns(scatterers.turns[points.sample[k]] + turns);
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

/// The same for point targets. A target keeps its own phase from ping to ping.
template <class Beams>
void add_particle_amplitudes(const CalibratedModel& model, const Beams& beams,
                             const SeenParticles& particles, const PingDraws& draws,
                             PingCounts& counts, EchoGrid& grid) {
    const PhiloxKey key = draws.of_scene(stream_named("particles"));
    PointScatterers scatterers{.points = particles.samples, .turns = {}};
    for (const std::uint32_t number : particles.numbers)
        scatterers.turns.push_back(unit_float(philox({number, 0, 0, 0}, key).x0));
    add_point_amplitudes(model, beams, scatterers, counts, grid);
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
