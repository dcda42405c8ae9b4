#pragma once

#include <array>
#include <optional>
#include <vector>

#include "calibrate/bootstrap.h"
#include "calibrate/patches.h"
#include "mission/instrument.h"

namespace sonarsim {

/// What was received: noise behind the matched filter has the spectrum |S|^2, an echo of many
/// scatterers |S|^4. With `speckle: scene` an echo is shared between two bins before the pulse,
/// with `speckle: ping` its amplitudes are drawn for whole bins.
enum class ReceivedKind { noise, echo, echo_of_bins };

ReceivedKind echo_kind(const SpeckleConfig& speckle);

/// The correlations of log powers 1 to patch_lags bins apart, for a pulse of so many bins. They are
/// those of the taps with which the model filters noise, or with which it spreads echoes.
std::array<double, patch_lags> predicted_range_correlations(double resolution_bins,
                                                            double side_lobe_db, ReceivedKind kind,
                                                            int looks);

/// The half-power width of the pulse, in bins, by the correlation along range of the chosen
/// patches. Nothing when neighbouring bins are not correlated: the pulse is shorter than about 0.8
/// bins then.
std::optional<Measured> fit_pulse(const std::vector<PatchMoments>& patches,
                                  const std::vector<std::size_t>& chosen, int places,
                                  double side_lobe_db, ReceivedKind kind, int looks);

}  // namespace sonarsim
