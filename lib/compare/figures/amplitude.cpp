#include "compare/figures/amplitude.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "calibrated/bottom.h"
#include "calibrated/decibel.h"
#include "core/elementary.h"

namespace sonarsim {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// The logarithms of the amplitudes above 0.
std::vector<float> logarithms(std::span<const float> amplitudes) {
    std::vector<float> out;
    out.reserve(amplitudes.size());
    for (const float a : amplitudes) {
        if (a >= std::numeric_limits<float>::min()) out.push_back(natural_log(a));
    }
    return out;
}

double mean_of(const std::vector<float>& values) {
    double sum = 0.0;
    for (const float v : values)
        sum += v;
    return sum / static_cast<double>(values.size());
}

/// The likelihood's derivative; the powers are taken relative to the largest amplitude.
double weibull_equation(const std::vector<float>& logs, double mean, float largest, float k) {
    // Eight sums, so that the loop vectorises.
    constexpr std::size_t lanes = 8;
    float weights[lanes] = {};
    float weighted[lanes] = {};
    const std::size_t whole = logs.size() / lanes * lanes;
    for (std::size_t i = 0; i < whole; i += lanes) {
        for (std::size_t j = 0; j < lanes; ++j) {
            const float below = largest - logs[i + j];
            const float weight = exp_neg(k * below);
            weights[j] += weight;
            weighted[j] += weight * below;
        }
    }
    double sum = 0.0;
    double product = 0.0;
    for (std::size_t j = 0; j < lanes; ++j) {
        sum += weights[j];
        product += weighted[j];
    }
    for (std::size_t i = whole; i < logs.size(); ++i) {
        const double weight = exp_neg(k * (largest - logs[i]));
        sum += weight;
        product += weight * (largest - logs[i]);
    }
    return largest - product / sum - 1.0 / k - mean;
}

}  // namespace

AmplitudeMoments amplitude_moments(std::span<const float> amplitudes) {
    const auto n = static_cast<double>(amplitudes.size());
    AmplitudeMoments out;
    for (const float a : amplitudes)
        out.mean += a / n;
    double second = 0.0;
    double third = 0.0;
    for (const float a : amplitudes) {
        const double off = a - out.mean;
        second += off * off / n;
        third += off * off * off / n;
    }
    const double deviation = std::sqrt(second);
    out.variation = out.mean > 0.0 ? deviation / out.mean : no_value;
    out.skewness = deviation > 0.0 ? third / (second * deviation) : no_value;
    return out;
}

double scintillation(std::span<const float> amplitudes) {
    double first = 0.0;
    double second = 0.0;
    for (const float a : amplitudes) {
        const double power = static_cast<double>(a) * a;
        first += power;
        second += power * power;
    }
    const auto n = static_cast<double>(amplitudes.size());
    return first > 0.0 ? second * n / (first * first) - 1.0 : no_value;
}

double weibull_shape(std::span<const float> amplitudes) {
    const std::vector<float> logs = logarithms(amplitudes);
    if (logs.size() < 2) return no_value;
    const auto [least, largest] = std::ranges::minmax(logs);
    if (!(largest > least)) return no_value;
    const double mean = mean_of(logs);
    double low = 0.2;
    double high = 12.0;
    // The equation rises with k. Sums of floats resolve no finer steps.
    constexpr int steps = 18;
    for (int step = 0; step < steps; ++step) {
        const double middle = 0.5 * (low + high);
        const bool is_above =
            weibull_equation(logs, mean, largest, static_cast<float>(middle)) > 0.0;
        (is_above ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

double inverse_k_shape(std::span<const float> amplitudes, double looks) {
    double sum = 0.0;
    double weighted = 0.0;
    double logs = 0.0;
    double n = 0.0;
    for (const float a : amplitudes) {
        if (!(a >= std::numeric_limits<float>::min())) continue;
        const double power = static_cast<double>(a) * a;
        const double log = 2.0 * natural_log(a);
        sum += power;
        weighted += power * log;
        logs += log;
        n += 1.0;
    }
    return n > 0.0 ? weighted / sum - logs / n - 1.0 / looks : no_value;
}

double spread_db(std::span<const float> amplitudes) {
    const std::vector<float> logs = logarithms(amplitudes);
    if (logs.empty()) return no_value;
    const double mean = mean_of(logs);
    double second = 0.0;
    for (const float log : logs)
        second += (log - mean) * (log - mean);
    return 20.0 / ln_10 * std::sqrt(second / static_cast<double>(logs.size()));
}

}  // namespace sonarsim
