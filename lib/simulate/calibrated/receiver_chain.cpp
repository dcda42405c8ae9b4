#include "simulate/calibrated/receiver_chain.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/elementary.h"
#include "core/normal_pair.h"
#include "core/units.h"
#include "simulate/calibrated/decibel.h"
#include "simulate/calibrated/levels.h"

namespace sonarsim {

namespace {

/// The ringing falls by 10 dB in each `ring_down_m`.
void add_ringing(const ReceiverConfig& receiver, const ImageRows& rows, std::span<float> image) {
    std::vector<float> ringing;
    for (int row = 0; row < rows.rows; ++row) {
        const double range_m = rows.range_min_m + (row + 0.5) * rows.bin_m;
        const double level_db = receiver.ring_down_db - 10.0 * range_m / receiver.ring_down_m;
        if (level_db < -60.0) break;  // a millionth of the noise
        ringing.push_back(rows.noise[row] * static_cast<float>(power_of_db(level_db)));
    }
    add_to_rows(ringing, rows, image);
}

void apply_beam_gains(const ReceiverConfig& receiver, const ImageRows& rows, const PingDraws& draws,
                      std::span<float> image) {
    std::vector<float> gains(rows.beams);
    for (int beam = 0; beam < rows.beams; ++beam) {
        const double off = (2.0 * beam + 1.0) / rows.beams - 1.0;  // the middle of the fan: 0
        gains[beam] = static_cast<float>(power_of_db(beam_gain_db(receiver, beam, draws) -
                                                     receiver.edge_loss_db * off * off));
    }
    for (std::size_t first = 0; first < image.size(); first += gains.size()) {
        for (std::size_t beam = 0; beam < gains.size(); ++beam)
            image[first + beam] = std::min(gains[beam] * image[first + beam], max_value);
    }
}

/// Foreign pulses begin by a Poisson process, have exponential powers and last as long as the
/// pulse. Each bin and beam of one has a draw of its own.
void add_interference(const ReceiverConfig& receiver, const ImageRows& rows, PhiloxKey key,
                      std::span<float> image) {
    const double window_s = rows.rows * rows.bin_s;
    const double mean_gap = 1.0 / (receiver.interference_per_s * window_s);
    const auto level = static_cast<float>(power_of_db(receiver.interference_db));
    double at = 0.0;  // in windows
    for (std::uint32_t pulse = 0;; ++pulse) {
        const PhiloxBlock draw = philox({pulse, 0, 0, 1}, key);
        at -= mean_gap * static_cast<double>(natural_log(unit_float(draw.x0)));
        if (at >= 1.0) return;
        const float power = -level * natural_log(unit_float(draw.x1));
        const int first = static_cast<int>(at * rows.rows);
        const int last = std::min(rows.rows, first + rows.pulse_bins);
        for (int row = first; row < last; ++row) {
            float* const values = image.data() + static_cast<std::size_t>(row) * rows.beams;
            for (int beam = 0; beam < rows.beams; ++beam) {
                const auto cell = static_cast<std::uint32_t>(row * rows.beams + beam);
                const float speckle = -natural_log(unit_float(philox({cell, pulse, 0, 2}, key).x0));
                values[beam] =
                    std::min(std::fma(rows.noise[row] * power, speckle, values[beam]), max_value);
            }
        }
    }
}

/// Weakens a whole ping, echoes and noise of the water alike, with the probability `loss_share`.
void lose_power(const ReceiverConfig& receiver, PhiloxKey key, std::span<float> image) {
    const PhiloxBlock draw = philox({0, 0, 0, 0}, key);
    if (static_cast<double>(unit_float(draw.x0)) > receiver.loss_share) return;
    const double loss_db =
        -receiver.loss_db * static_cast<double>(natural_log(unit_float(draw.x1)));
    const auto gain = static_cast<float>(power_of_db(-loss_db));
    for (float& value : image)
        value *= gain;
}

}  // namespace

void add_to_rows(std::span<const float> values, const ImageRows& rows, std::span<float> image) {
    for (std::size_t row = 0; row < values.size(); ++row) {
        for (float& value : image.subspan(row * rows.beams, rows.beams))
            value = std::min(value + values[row], max_value);
    }
}

double beam_gain_db(const ReceiverConfig& receiver, int beam, const PingDraws& draws) {
    const PhiloxKey key = stream_key(draws.seed, draws.sensor, 0, stream_named("beam gains"));
    const std::uint32_t word = philox({static_cast<std::uint32_t>(beam), 0, 0, 0}, key).x0;
    return receiver.beam_gain_db * normal_pair(word).first;
}

void add_faults(const ReceiverConfig& receiver, const ImageRows& rows, const PingDraws& draws,
                std::span<float> image) {
    if (receiver.loss_share > 0.0) lose_power(receiver, draws.of(stream_named("losses")), image);
    if (receiver.ring_down_db > 0.0) add_ringing(receiver, rows, image);
    if (receiver.interference_per_s > 0.0)
        add_interference(receiver, rows, draws.of(stream_named("interference")), image);
    if (receiver.beam_gain_db > 0.0 || receiver.edge_loss_db > 0.0)
        apply_beam_gains(receiver, rows, draws, image);
}

}  // namespace sonarsim
