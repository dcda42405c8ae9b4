#pragma once

#include <span>

#include "core/random.h"
#include "input/mission/instrument.h"
#include "simulate/trace/ping.h"

namespace sonarsim {

// The stages of a receiver after its beams and its gain; section 5 of docs/calibrated.md. Each is
// off by default.

/// The rows of an image in range.
struct ImageRows {
    double range_min_m = 0.0;
    double bin_m = 1.0;
    double bin_s = 1.0;  ///< two-way time of a bin
    int pulse_bins = 1;  ///< length of a pulse
    int rows = 0;
    int beams = 0;
    std::span<const float> noise;  ///< [rows] the value of the mean noise
};

/// Adds values to the bins of the first rows.
void add_to_rows(std::span<const float> values, const ImageRows& rows, std::span<float> image);

/// Adds ringing and foreign pulses, weakens pings, and applies the gains of beams.
void add_faults(const ReceiverConfig& receiver, const ImageRows& rows, const PingDraws& draws,
                std::span<float> image);

/// The gain of a beam, dB, the same in all pings.
double beam_gain_db(const ReceiverConfig& receiver, int beam, const PingDraws& draws);

}  // namespace sonarsim
