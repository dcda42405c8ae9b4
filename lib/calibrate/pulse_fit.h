#pragma once

#include <array>
#include <optional>
#include <vector>

#include "calibrate/bootstrap.h"
#include "calibrate/patches.h"
#include "calibrate/sampled_statistics.h"
#include "mission/instrument.h"

namespace sonarsim {

/// The kind of a received signal: noise after the matched filter has the spectrum |S|^2, an echo of
/// many scatterers |S|^4. With `speckle: scene` an echo is shared between two bins before the
/// pulse, with `speckle: ping` its amplitudes are drawn for whole bins.
enum class ReceivedKind { noise, echo, echo_of_bins };

ReceivedKind echo_kind(const SpeckleConfig& speckle);

/// The effect of an instrument's pulse on the values of a recording.
struct PulseModel {
    ReceiverConfig receiver;
    double side_lobe_db = -30.0;
    ReceivedKind kind = ReceivedKind::noise;

    /// The taps with which the model filters noise, or with which it spreads echoes, in steps of a
    /// sample of the receiver. `resolution_bins` is the half-power width of the pulse.
    std::vector<double> taps(double resolution_bins) const;
    /// The statistics of log powers.
    LogStatistics statistics(double resolution_bins) const;
    /// The correlations of log powers 1 to patch_lags bins apart.
    std::array<double, patch_lags> correlations(double resolution_bins) const;
};

PulseModel pulse_model(const InstrumentConfig& instrument, ReceivedKind kind);

/// The correlations that pulses of some widths predict.
struct PulseTable {
    std::vector<double> bins;
    std::vector<std::array<double, patch_lags>> rows;
};

/// All widths that a fit tries.
PulseTable pulse_table(const PulseModel& model);

/// The width of an instrument's pulse in bins; 1 if its resolution is that of a bin.
double pulse_bins_of(const PulseConfig& pulse, double range_step_m);

/// The half-power width of the pulse, in bins, fitted to the correlation along range of the chosen
/// patches. Nothing if neighbouring bins are not correlated: then the pulse is shorter than about
/// 0.8 bins.
std::optional<Bounded> fit_pulse(const std::vector<PatchMoments>& patches,
                                 const std::vector<std::size_t>& chosen, int places,
                                 const PulseModel& model);

}  // namespace sonarsim
