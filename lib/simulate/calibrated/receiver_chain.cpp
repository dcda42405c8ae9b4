#include "simulate/calibrated/receiver_chain.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/normal_pair.h"
#include "core/units.h"
#include "simulate/calibrated/decibel.h"
#include "simulate/calibrated/levels.h"

namespace sonarsim {

namespace {

float combined_power(SampleRule rule, const float* first, int samples, std::size_t stride) {
    float most = 0.0F;
    float amplitudes = 0.0F;
    float powers = 0.0F;
    for (int k = 0; k < samples; ++k) {
        const float power = first[k * stride];
        most = std::max(most, power);
        amplitudes += std::sqrt(power);
        powers += power;
    }
    const auto count = static_cast<float>(samples);
    if (rule == SampleRule::maximum) return most;
    if (rule == SampleRule::rms) return powers / count;
    const float mean = amplitudes / count;
    return mean * mean;
}

void add_to_row(float value, int row, const ImageRows& rows, std::span<float> image) {
    float* const first = image.data() + static_cast<std::size_t>(row) * rows.beams;
    for (int beam = 0; beam < rows.beams; ++beam)
        first[beam] = std::min(first[beam] + value, max_value);
}

/// The ringing falls by 10 dB in each `ring_down_m`.
void add_ringing(const ReceiverConfig& receiver, const ImageRows& rows, std::span<float> image) {
    for (int row = 0; row < rows.rows; ++row) {
        const double range_m = rows.range_min_m + (row + 0.5) * rows.bin_m;
        const double level_db = receiver.ring_down_db - 10.0 * range_m / receiver.ring_down_m;
        if (level_db < -60.0) return;  // a millionth of the noise
        const auto level = static_cast<float>(power_of_db(level_db));
        add_to_row(rows.noise[row] * level, row, rows, image);
    }
}

void apply_beam_gains(const ReceiverConfig& receiver, const ImageRows& rows, const PingDraws& draws,
                      std::span<float> image) {
    for (int beam = 0; beam < rows.beams; ++beam) {
        const auto gain = static_cast<float>(power_of_db(beam_gain_db(receiver, beam, draws)));
        for (auto k = static_cast<std::size_t>(beam); k < image.size(); k += rows.beams)
            image[k] = std::min(gain * image[k], max_value);
    }
}

}  // namespace

bool has_faults(const ReceiverConfig& receiver) {
    return receiver.ring_down_db > 0.0 || receiver.beam_gain_db > 0.0;
}

void combine_samples(std::span<const float> powers, int samples, SampleRule rule, int beams,
                     std::span<float> combined) {
    const auto stride = static_cast<std::size_t>(beams);
    for (std::size_t k = 0; k < combined.size(); ++k) {
        const float* const first = powers.data() + k / stride * stride * samples + k % stride;
        combined[k] = combined_power(rule, first, samples, stride);
    }
}

double beam_gain_db(const ReceiverConfig& receiver, int beam, const PingDraws& draws) {
    const PhiloxKey key = stream_key(draws.seed, draws.sensor, 0, stream_named("beam gains"));
    const std::uint32_t word = philox({static_cast<std::uint32_t>(beam), 0, 0, 0}, key).x0;
    return receiver.beam_gain_db * normal_pair(word).first;
}

void add_faults(const ReceiverConfig& receiver, const ImageRows& rows, const PingDraws& draws,
                std::span<float> image) {
    if (receiver.ring_down_db > 0.0) add_ringing(receiver, rows, image);
    if (receiver.beam_gain_db > 0.0) apply_beam_gains(receiver, rows, draws, image);
}

}  // namespace sonarsim
