#include "calibrate/sampled_statistics.h"

#include <cmath>
#include <complex>

#include "calibrated/receiver_chain.h"
#include "core/elementary.h"
#include "core/normal_pair.h"
#include "core/random.h"

namespace sonarsim {

namespace {

constexpr int drawn_bins = 80000;
constexpr int bins_of_correlations = 20000;
constexpr int steps_of_k2 = 16;

using DrawnSequence = std::vector<std::complex<float>>;

/// A white sequence filtered by the taps, of mean power 1.
DrawnSequence filtered(const std::vector<double>& taps, int count, std::uint32_t stream) {
    const PhiloxKey key = stream_key(1, stream, 0, stream_named("sampled statistics"));
    const int more = static_cast<int>(taps.size());
    DrawnSequence white;
    for (int k = 0; k < count + more; ++k) {
        const NormalPair z = normal_pair(philox({static_cast<std::uint32_t>(k), 0, 0, 0}, key).x0);
        white.emplace_back(z.first, z.second);
    }
    double energy = 0.0;
    for (const double tap : taps)
        energy += 2.0 * tap * tap;
    DrawnSequence out(static_cast<std::size_t>(count));
    for (std::size_t t = 0; t < taps.size(); ++t) {
        const auto tap = static_cast<float>(taps[t] / std::sqrt(energy));
        for (std::size_t k = 0; k < out.size(); ++k)
            out[k] += tap * white[k + t];
    }
    return out;
}

/// The logarithms of the values of bins, and of the first sample of each bin.
struct DrawnLogs {
    std::vector<double> bins, samples;
};

DrawnLogs drawn_logs(const ReceiverConfig& receiver, const std::vector<DrawnSequence>& looks) {
    std::vector<float> powers(looks.front().size());
    for (const DrawnSequence& look : looks) {
        for (std::size_t k = 0; k < powers.size(); ++k)
            powers[k] += std::norm(look[k]) / static_cast<float>(looks.size());
    }
    const auto samples = static_cast<std::size_t>(receiver.samples);
    std::vector<float> combined(powers.size() / samples);
    combine_samples(powers, receiver.samples, receiver.combine, 1, combined);
    DrawnLogs out;
    for (std::size_t k = 0; k < combined.size(); ++k) {
        out.bins.push_back(logarithm(std::max(combined[k], 1e-12F)));
        out.samples.push_back(logarithm(std::max(powers[k * samples], 1e-12F)));
    }
    return out;
}

std::vector<DrawnSequence> drawn_looks(int looks, const std::vector<double>& taps, int count,
                                       std::uint32_t stream) {
    std::vector<DrawnSequence> out;
    out.reserve(static_cast<std::size_t>(looks));
    for (int look = 0; look < looks; ++look)
        out.push_back(filtered(taps, count, stream + 2 * static_cast<std::uint32_t>(look)));
    return out;
}

double mean_of(const std::vector<double>& x) {
    double sum = 0.0;
    for (const double value : x)
        sum += value;
    return sum / static_cast<double>(x.size());
}

/// The mean product of the deviations of values `lag` apart.
double covariance(const std::vector<double>& a, const std::vector<double>& b, std::size_t lag) {
    const double mean_a = mean_of(a);
    const double mean_b = mean_of(b);
    double sum = 0.0;
    for (std::size_t k = 0; k + lag < a.size(); ++k)
        sum += (a[k] - mean_a) * (b[k + lag] - mean_b);
    return sum / static_cast<double>(a.size() - lag);
}

double skewness_of(const std::vector<double>& x) {
    const double mean = mean_of(x);
    double sum = 0.0;
    for (const double value : x)
        sum += (value - mean) * (value - mean) * (value - mean);
    return sum / static_cast<double>(x.size()) / power(covariance(x, x, 0), 1.5);
}

double variation_of(const std::vector<double>& logs) {
    double amplitude = 0.0, power = 0.0;
    for (const double log_power : logs) {
        amplitude += exponential(0.5 * log_power) / static_cast<double>(logs.size());
        power += exponential(log_power) / static_cast<double>(logs.size());
    }
    return std::sqrt(power / (amplitude * amplitude) - 1.0);
}

/// The correlation of the logs of two beams whose amplitudes have the squared correlation k2, less
/// that of single samples.
double excess_at(double k2, const ReceiverConfig& receiver, const std::vector<DrawnSequence>& one,
                 const std::vector<DrawnSequence>& other, const DrawnLogs& of_one) {
    std::vector<DrawnSequence> mixed = other;
    const auto own = static_cast<float>(std::sqrt(1.0 - k2));
    const auto shared = static_cast<float>(std::sqrt(k2));
    for (std::size_t look = 0; look < mixed.size(); ++look) {
        for (std::size_t k = 0; k < mixed[look].size(); ++k)
            mixed[look][k] = shared * one[look][k] + own * mixed[look][k];
    }
    const DrawnLogs logs = drawn_logs(receiver, mixed);
    const auto correlation = [](const std::vector<double>& a, const std::vector<double>& b) {
        return covariance(a, b, 0) / std::sqrt(covariance(a, a, 0) * covariance(b, b, 0));
    };
    return correlation(of_one.bins, logs.bins) - correlation(of_one.samples, logs.samples);
}

}  // namespace

LogStatistics sampled_statistics(const ReceiverConfig& receiver, const std::vector<double>& taps) {
    const int looks = std::max(receiver.looks, 1);
    LogStatistics out = log_statistics(looks);
    if (receiver.samples <= 1) return out;
    const int count = drawn_bins * receiver.samples;
    const std::vector<DrawnSequence> one = drawn_looks(looks, taps, count, 0);
    const std::vector<DrawnSequence> other = drawn_looks(looks, taps, count, 1);
    const DrawnLogs logs = drawn_logs(receiver, one);
    out.mean += mean_of(logs.bins) - mean_of(logs.samples);
    out.variance += covariance(logs.bins, logs.bins, 0) - covariance(logs.samples, logs.samples, 0);
    out.skewness += skewness_of(logs.bins) - skewness_of(logs.samples);
    out.variation += variation_of(logs.bins) - variation_of(logs.samples);
    for (int k = 0; k <= steps_of_k2; ++k)
        out.excess.push_back(excess_at(1.0 * k / steps_of_k2, receiver, one, other, logs));
    return out;
}

std::array<double, patch_lags> sampled_range_correlations(const ReceiverConfig& receiver,
                                                          const std::vector<double>& taps) {
    const int looks = std::max(receiver.looks, 1);
    std::array<double, patch_lags> out{};
    double energy = 0.0;
    for (const double tap : taps)
        energy += tap * tap;
    for (std::size_t lag = 1; lag <= patch_lags; ++lag) {
        const std::size_t apart = lag * static_cast<std::size_t>(receiver.samples);
        double k = 0.0;
        for (std::size_t t = 0; t + apart < taps.size(); ++t)
            k += taps[t] * taps[t + apart] / energy;
        out[lag - 1] = log_power_correlation(k * k, looks);
    }
    if (receiver.samples <= 1) return out;
    const DrawnLogs logs =
        drawn_logs(receiver, drawn_looks(looks, taps, bins_of_correlations * receiver.samples, 0));
    const double of_bins = covariance(logs.bins, logs.bins, 0);
    const double of_samples = covariance(logs.samples, logs.samples, 0);
    for (std::size_t lag = 1; lag <= patch_lags; ++lag) {
        out[lag - 1] += covariance(logs.bins, logs.bins, lag) / of_bins -
                        covariance(logs.samples, logs.samples, lag) / of_samples;
    }
    return out;
}

}  // namespace sonarsim
