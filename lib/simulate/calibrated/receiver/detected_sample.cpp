#include <algorithm>

#include "core/elementary.h"
#include "core/lanes.h"
#include "simulate/calibrated/receiver/receiver_chain.h"
#include "simulate/calibrated/signal/normals.h"

namespace sonarsim {

namespace {

// The table by log2 of the power in means.
constexpr double first_octave = -24.0;
constexpr double last_octave = 6.0;
constexpr int steps_per_octave = 32;
constexpr int steps = static_cast<int>(last_octave - first_octave) * steps_per_octave;
constexpr double ln_2 = 0.6931471805599453;
constexpr float log2_e = 1.44269504F;

/// A distribution of delivered values, in equal steps of ln: ln(-ln(1 - F)), ln x of that rank.
struct Ranks {
    std::vector<double> ln_value, ln_x;

    /// `below` and `above`: F and 1 - F.
    void add(double value, double below, double above) {
        const double x =
            below < 0.5 ? (below < 1e-6 ? below : -logarithm(1.0 - below)) : -logarithm(above);
        if (!(x > 0.0)) return;
        ln_value.push_back(logarithm(value));
        ln_x.push_back(logarithm(x));
    }
};

/// The values at which distributions are computed.
std::vector<double> values(double first, double last) {
    constexpr int count = 6000;
    std::vector<double> out(count);
    for (int k = 0; k < count; ++k)
        out[k] = exponential(std::lerp(logarithm(first), logarithm(last), (k + 0.5) / count));
    return out;
}

Ranks ranks_of_largest(double samples) {
    Ranks out;
    for (const double v : values(1e-8, 120.0)) {
        const double e = exponential(-v);
        // 1 - e^-v, and its power, without cancellation at either end.
        const double single = v < 1e-4 ? v * (1.0 - 0.5 * v) : 1.0 - e;
        const double above = samples * e < 1e-4 ? samples * e : 1.0 - power(single, samples);
        out.add(v, power(single, samples), above);
    }
    return out;
}

Ranks ranks_of_mean(double samples) {
    // dF = z^(n-1) e^-z dz = z^n e^-z dln z, z = n v.
    const std::vector<double> at = values(1e-12, 120.0);
    std::vector<double> density;
    density.reserve(at.size());
    for (const double v : at)
        density.push_back(exponential(samples * (logarithm(v) - v + 1.0)));
    std::vector<double> below(at.size()), above(at.size());
    double sum = 0.0;
    for (std::size_t k = 0; k < at.size(); ++k) {
        below[k] = sum + 0.5 * density[k];
        sum += density[k];
    }
    double rest = 0.0;
    for (std::size_t k = at.size(); k-- > 0; rest += density[k])
        above[k] = rest + 0.5 * density[k];
    Ranks out;
    for (std::size_t k = 0; k < at.size(); ++k)
        out.add(at[k], below[k] / sum, above[k] / sum);
    return out;
}

}  // namespace

DetectedSample::DetectedSample(const ReceiverConfig& receiver) {
    if (!(receiver.samples > 1.0) && receiver.expansion == 1.0) return;
    const Ranks ranks = receiver.combine == SampleRule::maximum ? ranks_of_largest(receiver.samples)
                                                                : ranks_of_mean(receiver.samples);
    std::vector<double> value;
    double mean = 0.0;
    std::size_t k = 1;
    for (int step = 0; step <= steps; ++step) {
        const double ln_x = ln_2 * (first_octave + static_cast<double>(step) / steps_per_octave);
        while (k + 1 < ranks.ln_x.size() && ranks.ln_x[k] < ln_x)
            ++k;
        const double share = (ln_x - ranks.ln_x[k - 1]) / (ranks.ln_x[k] - ranks.ln_x[k - 1]);
        const double ln_value = std::lerp(ranks.ln_value[k - 1], ranks.ln_value[k], share);
        value.push_back(exponential(receiver.expansion * ln_value));
        // The integral of y e^-x dx = y x e^-x dln x.
        const double x = exponential(ln_x);
        mean += value.back() * x * exponential(-x) * ln_2 / steps_per_octave;
    }
    value_.assign(value.size(), 0.0F);
    std::ranges::transform(value, value_.begin(),
                           [&](double y) { return static_cast<float>(y / mean); });
    last_gain_ = value_.back() / static_cast<float>(power(2.0, last_octave));
    value_.push_back(value_.back());
}

void DetectedSample::apply(std::span<const float> mean, std::span<float> power) const {
    constexpr auto last_step = static_cast<float>(steps);
    const auto delivered = [&](Floats8 means, Floats8 powers) {
        const Floats8 at =
            (natural_log_of_8(powers / means) * log2_e - static_cast<float>(first_octave)) *
            static_cast<float>(steps_per_octave);
        // In this order of arguments NaN becomes 0.
        const Floats8 inside = min(max(at, 0.0F), last_step);
        const Floats8 cell = floor(inside);
        const auto [here, next] = table_entries(value_.data(), to_ints(cell));
        const Floats8 within = means * fma(inside - cell, next - here, here);
        const Floats8 drawn = where(at >= last_step, powers * last_gain_, within);
        return where((means > 0.0F) & (powers > 0.0F), drawn, powers);
    };
    std::size_t k = 0;
    for (; k + lanes <= power.size(); k += lanes)
        delivered(Floats8::load(&mean[k]), Floats8::load(&power[k])).store(&power[k]);
    for (; k < power.size(); ++k)
        power[k] = delivered(mean[k], power[k])[0];
}

}  // namespace sonarsim
