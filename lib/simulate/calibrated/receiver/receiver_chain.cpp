#include "simulate/calibrated/receiver/receiver_chain.h"

#include "core/decibel.h"
#include "core/elementary.h"
#include "core/lanes.h"
#include "core/units.h"
#include "simulate/calibrated/equation/bottom.h"
#include "simulate/calibrated/equation/instrument_levels.h"
#include "simulate/calibrated/signal/normals.h"

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
        gains[beam] = static_cast<float>(power_of_db(beam_gain_db(receiver, beam, draws)));
    }
    for (std::size_t first = 0; first < image.size(); first += gains.size()) {
        for (std::size_t beam = 0; beam < gains.size(); ++beam)
            image[first + beam] = std::min(gains[beam] * image[first + beam], max_value);
    }
}

/// Foreign pulses begin by a Poisson process, have exponential powers and last at least as long as
/// the pulse. Each bin and beam of one has a draw of its own.
void add_interference(const ReceiverConfig& receiver, const ImageRows& rows, PhiloxKey key,
                      std::span<float> image) {
    const double window_s = rows.rows * rows.bin_s;
    const double mean_gap = 1.0 / (receiver.interference_per_s * window_s);
    const auto level = static_cast<float>(power_of_db(receiver.interference_db));
    const double length_s = std::max(receiver.interference_s, rows.pulse_s);
    const int bins = std::max(1, static_cast<int>(std::lround(length_s / rows.bin_s)));
    double at = -length_s / window_s;  // in windows; long pulses may begin before the first
    for (std::uint32_t pulse = 0;; ++pulse) {
        const PhiloxBlock draw = philox({pulse, 0, 0, 1}, key);
        at -= mean_gap * static_cast<double>(natural_log(unit_float(draw.x0)));
        if (at >= 1.0) return;
        const float power = -level * natural_log(unit_float(draw.x1));
        const int first = static_cast<int>(std::floor(at * rows.rows));
        const int last = std::min(rows.rows, first + bins);
        for (int row = std::max(first, 0); row < last; ++row) {
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

// The smallest power for the logarithm: it is a normal float, and every companding makes it 0.
constexpr float min_power = 1e-37F;

/// The function from the natural logarithm of the power, 0 at full scale, to a value: 1 there.
struct Law {
    bool logarithmic;
    float factor;

    float value(float logarithm_of_power) const {
        return logarithmic ? std::max(1.0F + factor * logarithm_of_power, 0.0F)
                           : exp_neg(-factor * logarithm_of_power);
    }
};

Law law_of(const ReceiverConfig& receiver) {
    switch (receiver.companding) {
        case Companding::log:
            return {true, static_cast<float>(10.0 / (ln_10 * receiver.dynamic_range_db))};
        case Companding::linear:
            return {false, 0.5F};
        default:
            return {false, static_cast<float>(0.5 * receiver.gamma)};
    }
}

// Powers of more than 60 dB above full scale count as that.
constexpr float max_power = 1e6F;

/// The value v above a knee k becomes 1 - (1 - k) exp(-(v - k) / (1 - k)), whose slope at k is 1.
float compressed(float value, float knee) {
    if (!(value > knee)) return value;
    return 1.0F - (1.0F - knee) * exp_neg((value - knee) / (1.0F - knee));
}

// Fit: ghosts of bright things in half of the training fans of an ARIS 3000, by steps of 10 dB.
constexpr float leak_power = 1e-3F;

// Power this far below the echo in the same bin changes it by at most a grey, and is left out.
constexpr float negligible = 0.003F;

}  // namespace

void add_to_rows(std::span<const float> values, const ImageRows& rows, std::span<float> image) {
    for (std::size_t row = 0; row < values.size(); ++row) {
        for (float& value : image.subspan(row * rows.beams, rows.beams))
            value = std::min(value + values[row], max_value);
    }
}

std::vector<float> edge_gains(const ReceiverConfig& receiver, std::span<const double> sines,
                              double azimuth_rad) {
    std::vector<float> gains;
    if (!(receiver.edge_loss_db > 0.0)) return gains;
    for (const double sine : sines) {
        const double off = 2.0 / azimuth_rad * arcsin(std::clamp(sine, -1.0, 1.0));
        gains.push_back(static_cast<float>(power_of_db(-receiver.edge_loss_db * off * off)));
    }
    return gains;
}

double beam_gain_db(const ReceiverConfig& receiver, int beam, const PingDraws& draws) {
    const PhiloxKey key = stream_key(draws.seed, draws.sensor, 0, stream_named("beam gains"));
    const auto channel = static_cast<std::uint32_t>(beam / receiver.channel_beams);
    const std::uint32_t word = philox({channel, 0, 0, 0}, key).x0;
    return receiver.beam_gain_db * normal_pair(word).first;
}

void add_mean_leaks(const ReceiverConfig& receiver, int beams, std::span<float> image) {
    const int step = receiver.channel_beams;
    if (step == 1 || step >= beams) return;
    for (std::size_t row = 0; row < image.size(); row += beams) {
        for (int turn = 0; turn < step; ++turn) {
            float sum = 0.0F;
            for (int beam = turn; beam < beams; beam += step)
                sum += image[row + beam];
            for (int beam = turn; beam < beams; beam += step)
                image[row + beam] += leak_power * (sum - image[row + beam]);
        }
    }
}

void add_leaks(const ReceiverConfig& receiver, int beams, PhiloxKey key, std::span<float> image) {
    const int step = receiver.channel_beams;
    if (step == 1 || step >= beams) return;
    const float leak = std::sqrt(leak_power);
    const auto half = std::ptrdiff_t{lanes} * ((beams + 2 * lanes - 1) / (2 * lanes));
    std::vector<std::uint32_t> words(2 * half);
    std::vector<float> re(2 * half), im(2 * half);
    for (std::size_t row = 0; row * beams < image.size(); ++row) {
        float* const powers = image.data() + row * beams;
        for (std::ptrdiff_t k = 0; k < half; ++k) {
            words[k] = static_cast<std::uint32_t>(k);
            words[half + k] = static_cast<std::uint32_t>(row);
        }
        philox_pairs(words.data(), words.data() + half, static_cast<int>(half), key);
        std::copy_n(powers, beams, re.begin());
        for (std::ptrdiff_t k = 0; k < 2 * half; k += lanes) {
            const Floats8 turns = to_floats(load_words(&words[k]) >> 8) * 0x1p-24F - 0.5F;
            const Complexes8 unit = unit_vectors_of_8(static_cast<float>(2.0 * pi) * turns);
            const Floats8 amplitude = sqrt(max(Floats8::load(&re[k]), 0.0F));
            (amplitude * unit.re).store(&re[k]);
            (amplitude * unit.im).store(&im[k]);
        }
        for (int turn = 0; turn < step; ++turn) {
            float sum_re = 0.0F;
            float sum_im = 0.0F;
            for (int beam = turn; beam < beams; beam += step) {
                sum_re += leak * re[beam];
                sum_im += leak * im[beam];
            }
            for (int beam = turn; beam < beams; beam += step) {
                const float a = std::fma(1.0F - leak, re[beam], sum_re);
                const float b = std::fma(1.0F - leak, im[beam], sum_im);
                powers[beam] = std::min(a * a + b * b, max_value);
            }
        }
    }
}

void add_faults(const ReceiverConfig& receiver, const ImageRows& rows, const PingDraws& draws,
                std::span<float> image) {
    if (receiver.loss_share > 0.0) lose_power(receiver, draws.of(stream_named("losses")), image);
    if (receiver.ring_down_db > 0.0) add_ringing(receiver, rows, image);
    if (receiver.interference_per_s > 0.0)
        add_interference(receiver, rows, draws.received(stream_named("interference")), image);
    if (receiver.beam_gain_db > 0.0) apply_beam_gains(receiver, rows, draws, image);
}

std::vector<std::uint16_t> companded(std::span<const float> powers,
                                     const ReceiverConfig& receiver) {
    const Law law = law_of(receiver);
    const auto full_value = static_cast<float>((1 << receiver.bits) - 1);
    const auto offset = static_cast<float>(receiver.offset);
    const auto knee = static_cast<float>(receiver.knee);
    const bool has_knee = knee < 1.0F;
    const float ceiling = has_knee ? max_power : 1.0F;
    const float ln_max = has_knee ? natural_log(max_power) : 0.0F;
    std::vector<std::uint16_t> out(powers.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const float power = std::min(std::max(powers[i], min_power), ceiling);
        float value = law.value(std::min(natural_log(power), ln_max));
        if (has_knee) value = compressed(value, knee);
        const float above = std::max(value - offset, 0.0F);
        out[i] = static_cast<std::uint16_t>(static_cast<std::int32_t>(full_value * above + 0.5F));
    }
    return out;
}

Reverberation::Reverberation(const ReceiverConfig& receiver, double bin_m, double sound_speed_m_s) {
    if (!(receiver.reverberation_s > 0.0)) return;
    share = static_cast<float>(power_of_db(receiver.reverberation_db));
    const double bin_s = 2.0 * bin_m / sound_speed_m_s;
    decay = static_cast<float>(power(10.0, -6.0 * bin_s / receiver.reverberation_s));
}

void add_tails(const Reverberation& tail, const float* echoes, std::span<float> drawn) {
    if (!(tail.share > 0.0F)) return;
    const float share = (1.0F - tail.decay) * tail.share;
    float reverberant = 0.0F;
    for (std::size_t row = 0; row < drawn.size(); ++row) {
        const float echo = echoes[2 * row];
        const float power = drawn[row] + reverberant;
        reverberant = std::fma(tail.decay, reverberant, share * (echo + drawn[row]));
        // A branch would often be predicted wrongly.
        drawn[row] = power * static_cast<float>(power > negligible * echo);
    }
}

}  // namespace sonarsim
