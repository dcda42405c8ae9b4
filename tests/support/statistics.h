#pragma once

#include "support/test.h"

namespace sonarsim::test {

/// The probability of a Kolmogorov-Smirnov distance above `distance` for n draws. The asymptotic
/// law 2 sum (-1)^(k-1) exp(-2 k^2 t^2) with Stephens' correction of t for n.
inline double kolmogorov_tail(double distance, double n) {
    const double t = distance * (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n));
    if (t < 0.2) return 1.0;
    double p = 0.0;
    for (int k = 1; k <= 100; ++k)
        p += (k % 2 ? 2.0 : -2.0) * std::exp(-2.0 * k * k * t * t);
    return std::clamp(p, 0.0, 1.0);
}

/// Two-sided p-value of the Kolmogorov-Smirnov test of `draws` against a continuous distribution.
inline double ks_p_value(std::vector<double> draws, const std::function<double(double)>& cdf) {
    std::sort(draws.begin(), draws.end());
    const auto n = static_cast<double>(draws.size());
    double distance = 0.0;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const double f = cdf(draws[i]);
        distance = std::max(
            {distance, (static_cast<double>(i) + 1.0) / n - f, f - static_cast<double>(i) / n});
    }
    return kolmogorov_tail(distance, n);
}

/// The same for two samples of one law. Ties (pixels that are exactly 0) count as one step.
inline double ks_two_samples_p_value(std::vector<double> a, std::vector<double> b) {
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    const auto n = static_cast<double>(a.size());
    const auto m = static_cast<double>(b.size());
    double distance = 0.0;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const double x = std::min(a[i], b[j]);
        while (i < a.size() && a[i] <= x)
            ++i;
        while (j < b.size() && b[j] <= x)
            ++j;
        distance =
            std::max(distance, std::fabs(static_cast<double>(i) / n - static_cast<double>(j) / m));
    }
    return kolmogorov_tail(distance, n * m / (n + m));
}

/// The significance level of each of `tests` independent tests, so that all together reject a true
/// hypothesis once in a thousand (Sidak).
inline double sidak(int tests) {
    return 1.0 - std::pow(1.0 - 1e-3, 1.0 / tests);
}

inline double mean(const std::vector<double>& x) {
    return total(x) / static_cast<double>(x.size());
}

/// Numbers as an array of Eigen's.
inline Eigen::Map<const Eigen::ArrayXd> array_of(const std::vector<double>& x) {
    return {x.data(), std::ssize(x)};
}

inline double deviation(const std::vector<double>& x) {
    return std::sqrt((array_of(x) - mean(x)).square().sum() / static_cast<double>(x.size() - 1));
}

inline double standard_error(const std::vector<double>& x) {
    return deviation(x) / std::sqrt(static_cast<double>(x.size()));
}

/// Pearson's correlation of two lists of one length.
inline double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const Eigen::ArrayXd off_a = array_of(a) - mean(a);
    const Eigen::ArrayXd off_b = array_of(b) - mean(b);
    return (off_a * off_b).sum() / std::sqrt(off_a.square().sum() * off_b.square().sum());
}

}  // namespace sonarsim::test
