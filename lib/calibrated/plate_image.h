#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "calibrated/array_beams.h"
#include "calibrated/sonar_equation.h"
#include "calibrated/transducer_beams.h"
#include "scene/scene.h"
#include "trace/plates.h"
#include "visibility/view.h"

namespace sonarsim {

/// The plates of a ping and what their echoes depend on.
struct PlateScene {
    std::span<const PlateOfPing> plates;
    std::span<const Material> materials;
    const View& view;  ///< with its guard beams; nothing outside of it is insonified
    double wavelength_m = 0.0;
};

/// Adds the complex amplitudes of the plates' coherent echoes to the grid. Returns how many of
/// their parts lie outside the view, the range or the beams.
template <class Beams>
std::uint64_t add_plate_amplitudes(const Beams& beams, const PlateScene& scene,
                                   const SonarEquation& equation, const PointLimits& limits,
                                   EchoGrid& grid);

extern template std::uint64_t add_plate_amplitudes(const TransducerBeams&, const PlateScene&,
                                                   const SonarEquation&, const PointLimits&,
                                                   EchoGrid&);
extern template std::uint64_t add_plate_amplitudes(const ArrayBeams&, const PlateScene&,
                                                   const SonarEquation&, const PointLimits&,
                                                   EchoGrid&);

/// The samples with the areas that scatter incoherently. On a plate the share exp(-(2 k h sin)^2)
/// of the power is coherent, and the area keeps the rest.
std::vector<Sample> incoherent_samples(std::span<const Sample> samples, const PlateScene& scene);

}  // namespace sonarsim
