#pragma once

#include <limits>

#include "input/mission/instrument.h"
#include "input/mission/mission.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// The levels of an instrument in the unit of its source level, and the quantities from which
/// `auto` levels follow; section 5 of docs/calibrated.md.
struct InstrumentLevels {
    double source_level_db = 0.0;
    double noise_db = 0.0;       ///< power in a beam
    double full_scale_db = 0.0;  ///< echo level after TVG
    double sand_db = 0.0;        ///< mean of sand at half of the range after TVG
    bool relative = false;       ///< levels are relative to the source level, not re 1 uPa

    double noise_hz = 0.0;  ///< PulseBand::noise_hz
    double receiving_directivity_db = 0.0;
    double transmitting_directivity_db = 0.0;
    double thermal_noise_db = 0.0;  ///< spectra, dB re 1 uPa^2/Hz
    double wind_noise_db = 0.0;
};

/// The 99 % quantile of speckle, whose powers are exponential, over its mean: ln 100.
inline constexpr double speckle_p99 = 4.60517;

/// The levels that are given, and the others by rule:
///
/// - Source level: 170.8 dB + 10 log(power_w efficiency) + the transmitter's directivity index. It
///   is 0 if another level is below 0 dB and so relative to it.
/// - Noise: thermal noise, raised by noise figure and efficiency, and that of the wind, in the band
///   of the matched filter, less the receiving directivity index. If the source level is relative,
///   the noise is relative to the source level of the rule.
/// - Full scale: after TVG the 99 % quantile of the speckle of a sand bottom at half of the range
///   is the largest value; if companding is not `gamma`, its mean is a third of that value. It is
///   less where the noise at range_max_m would otherwise be above two thirds.
InstrumentLevels instrument_levels(const InstrumentConfig& instrument, const WaterConfig& water,
                                   const View& view);

/// The gain k log10 r + 2 alpha r at a range.
double tvg_db(const ReceiverConfig& receiver, double absorption_db_per_m, double range_m);

// Missions may set levels over 600 dB, whose sums are many times greater, but a float holds 380 dB
// to either side of 1. These limits keep all values finite. Levels of real instruments stay.

/// The dB that are added to the powers of the grid of echoes, which are ratios to the source level,
/// so that floats hold the noise of the receiver and the echoes above it. `noise_db` is relative to
/// the source level. 0 where the noise lies within -300 and 200 dB.
double float_headroom_db(double noise_db);

/// The greatest power of an echo in the grid. A million that add in phase are finite in a beam.
inline constexpr float max_echo = 1e24F;

/// The greatest value of an image: 300 dB above full scale, at which the receiver clips.
inline constexpr float max_value = 1e30F;

/// The factors from powers of the grid to values of the image, by bin: source level, gain and full
/// scale. They are at most 370 dB, which lifts the least noise, -300 dB, above full scale.
std::vector<float> row_gains(const ReceiverConfig& receiver, const InstrumentLevels& levels,
                             const View& view, double absorption_db_per_m, double raised_db);

/// The value of a power. NaN stays NaN.
inline float value_of(float gain, float power, float before = 0.0F) {
    const float finite = std::min(power, std::numeric_limits<float>::max());
    return std::min(std::fma(gain, finite, before), max_value);
}

}  // namespace sonarsim
