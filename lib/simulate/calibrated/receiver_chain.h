#pragma once

#include <span>

#include "core/random.h"
#include "input/mission/instrument.h"
#include "simulate/trace/ping.h"

namespace sonarsim {

// The stages of a receiver after its beams and its gain; section 4 of docs/calibrated.md. Each is
// off by default.

/// True if any stage changes an image.
bool has_faults(const ReceiverConfig& receiver);

/// Combines every `samples` rows of an image of powers into one: [rows * samples, beams] becomes
/// [rows, beams].
void combine_samples(std::span<const float> powers, int samples, SampleRule rule, int beams,
                     std::span<float> combined);

/// The rows of an image in range.
struct ImageRows {
    double range_min_m = 0.0;
    double bin_m = 1.0;
    int rows = 0;
    int beams = 0;
    std::span<const float> noise;  ///< [rows] the value of the mean noise
};

/// Adds ringing and applies the gains of beams.
void add_faults(const ReceiverConfig& receiver, const ImageRows& rows, const PingDraws& draws,
                std::span<float> image);

/// The gain of a beam, dB, the same in all pings.
double beam_gain_db(const ReceiverConfig& receiver, int beam, const PingDraws& draws);

}  // namespace sonarsim
