#include "calibrate/log_statistics.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/log_gamma.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr double euler = 0.57721566490153286;
constexpr double zeta_3 = 1.2020569031595943;

/// The sum of 1 / k^exponent for k from 1 to looks - 1.
double sum_of_inverse_powers(int looks, int exponent) {
    double sum = 0.0;
    for (int k = 1; k < looks; ++k)
        sum += power(k, -exponent);
    return sum;
}

}  // namespace

double log_power_variance(int looks) {
    return pi * pi / 6.0 - sum_of_inverse_powers(looks, 2);
}

double log_power_skewness(int looks) {
    const double third = -2.0 * (zeta_3 - sum_of_inverse_powers(looks, 3));
    return third / power(log_power_variance(looks), 1.5);
}

double log_power_mean(int looks) {
    return sum_of_inverse_powers(looks, 1) - euler - logarithm(looks);
}

double gamma_amplitude_variation(double shape) {
    // The mean of sqrt(P) of a gamma distribution with mean 1.
    const double mean = exponential(log_gamma(shape + 0.5) - log_gamma(shape)) / std::sqrt(shape);
    return std::sqrt(1.0 / (mean * mean) - 1.0);
}

double amplitude_variation(int looks) {
    return gamma_amplitude_variation(looks);
}

double log_power_correlation(double k2, int looks) {
    if (k2 >= 1.0) return 1.0;
    double sum = 0.0;
    double factor = 1.0;  // k2^j / h_j
    for (int j = 1; j <= 400; ++j) {
        factor *= k2 * j / (looks + j - 1.0);
        sum += factor / (1.0 * j * j);
        if (factor < 1e-9) break;
    }
    return sum / log_power_variance(looks);
}

double LogStatistics::correlation(double k2) const {
    const double of_looks = log_power_correlation(k2, looks);
    if (excess.empty()) return of_looks;
    const double at = std::clamp(k2, 0.0, 1.0) * static_cast<double>(excess.size() - 1);
    const auto k = std::min(static_cast<std::size_t>(at), excess.size() - 2);
    const double part = at - static_cast<double>(k);
    return of_looks + (1.0 - part) * excess[k] + part * excess[k + 1];
}

LogStatistics log_statistics(int looks) {
    return {.looks = looks,
            .mean = log_power_mean(looks),
            .variance = log_power_variance(looks),
            .skewness = log_power_skewness(looks),
            .variation = amplitude_variation(looks),
            .excess = {}};
}

}  // namespace sonarsim
