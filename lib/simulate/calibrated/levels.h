#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "input/mission/instrument.h"
#include "simulate/calibrated/instrument_levels.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

// Missions may set levels over 600 dB, whose sums are many times greater, but a float holds 380 dB
// to either side of 1. These limits keep all values finite. They change nothing at the levels of
// real instruments.

/// The dB that are added to the powers of the grid of echoes, which are ratios to the source level,
/// so that floats hold the noise of the receiver and the echoes above it. `noise_db` is relative to
/// the source level. 0 where the noise lies within -300 and 200 dB.
double float_headroom_db(double noise_db);

/// The greatest power of an echo in the grid, 40 dB above the greatest noise there. A million such
/// echoes that add in phase are finite in every beam.
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
