#pragma once

#include "input/scene/scene.h"
#include "simulate/calibrated/equation/bottom.h"
#include "simulate/calibrated/equation/sonar_equation.h"
#include "simulate/calibrated/signal/echo_grid.h"

namespace sonarsim {

/// The scattering of sea beds, divided between their surface and the sediment below it.
///
/// The volume part of the bottom model is an integral over the depth z in the sediment. The two-way
/// power decays as exp(-4 k Im(q) z), with q the vertical wave number in the sediment over k, the
/// wave number in the water (SeafloorScattering). Its two-way phase grows by 2 k Re(q) z, like that
/// of a path in the water that is Re(q) z longer one way. So the echo falls over the range s behind
/// the surface as exp(-s / lag), lag = Re(q) / (4 k Im(q)), with the energy of the model. At normal
/// incidence that is 1 / (4 k loss): the decay is that of the sediment's attenuation.
struct SedimentScattering {
    Scattering surface;        ///< without the volume of sea beds
    Scattering volume;         ///< sea beds alone
    std::vector<float> lag_m;  ///< [materials, AngularTable::size] mean range behind the surface
    std::vector<bool> has;     ///< [materials] true if in `volume`
};

/// `whole`: of the same materials. Beds whose tail is a small part of a bin stay; nothing: all do.
std::optional<SedimentScattering> sediment_scattering(std::span<const Material> materials,
                                                      double frequency_hz, const Water& water,
                                                      double bin_m, const Scattering& whole);

/// Multiplies the powers of echoes by the mean lag of their sediment, in bins.
void weigh_by_lag(const SedimentScattering& sediment, const PatchBlock& pieces, float bin_m,
                  PointEchoes& echoes);

/// Spreads energy, the real parts of `energy`, over the bins behind it: the energy e of a bin falls
/// as exp(-s / lag). `lagged` holds e times its lag in bins; where echoes of several lags meet,
/// their mean lag counts. The sum of a column stays the same except for energy behind the last bin.
void spread_below(const EchoGrid& lagged, EchoGrid& energy);

}  // namespace sonarsim
