#pragma once

#include <cmath>
#include <cstdint>

#include "core/elementary.h"
#include "core/normal_pair.h"
#include "core/random.h"
#include "recording/recording.h"

namespace sonarsim::test {

/// A law of drawn speckle.
struct DrawnLaw {
    double level_db = -20.0;
    bool is_k = false;          ///< K-distributed of shape 2, else Rayleigh
    float beam_mixture = 0.0F;  ///< share of the neighbour's amplitude that leaks into a beam
};

/// An imaging recording of 6 pings, 128 ranges and 64 beams that obeys a law, another one for each
/// `number`. Complex amplitudes are independent but for the mixture; K is Rayleigh times the root
/// of a mean of two exponential draws.
inline Recording drawn_recording(std::uint32_t number, const DrawnLaw& law) {
    constexpr int ranges = 128, beams = 64;
    Recording recording;
    recording.law.kind = RecordedLaw::Kind::power;
    recording.law.full_value = 1;
    recording.first_range_m = 1.0;
    recording.range_step_m = 0.01;
    for (int j = 0; j < beams; ++j)
        recording.bearing_rad.push_back(0.01 * (j - beams / 2));
    const double scale = power(10.0, law.level_db / 10.0);
    for (std::uint32_t k = 0; k < 6; ++k) {
        RecordedPing ping;
        ping.time_s = 0.1 * k;
        ping.ranges = ranges;
        ping.beams = beams;
        for (std::uint32_t i = 0; i < ranges; ++i) {
            NormalPair last{0.0F, 0.0F};
            for (std::uint32_t j = 0; j < beams; ++j) {
                const PhiloxBlock draw = philox({number, k, i, j}, {0x636f6d70U, 0});
                const NormalPair own = normal_pair(draw.x0);
                const float re = own.first + law.beam_mixture * last.first;
                const float im = own.second + law.beam_mixture * last.second;
                last = own;
                double value = 0.5 * scale * (re * re + im * im);
                if (law.is_k)
                    value *= -0.5 *
                             (natural_log(unit_float(draw.x1)) + natural_log(unit_float(draw.x2)));
                ping.values.push_back(static_cast<float>(value));
            }
        }
        recording.pings.push_back(std::move(ping));
    }
    return recording;
}

}  // namespace sonarsim::test
