#pragma once

#include <vector>

namespace sonarsim {

// Closed forms of ln P, P the mean power of n independent looks at speckle or noise: P is gamma
// distributed with shape n. A companding law P^(g / 2) or a + b ln P only scales ln P and shifts
// it, so its skewness and its correlations do not depend on the law.

/// Variance of ln P: the trigamma function of n; pi^2 / 6 for one look.
double log_power_variance(int looks);

/// Skewness of ln P: -1.14 for one look, -0.78 for two.
double log_power_skewness(int looks);

/// Mean of ln P where P has the mean 1: digamma(n) - ln n; minus Euler's constant for one look.
double log_power_mean(int looks);

/// Coefficient of variation of the amplitude, the root of P: 0.5227 for one look.
double amplitude_variation(int looks);

/// The same for powers of gamma's distribution with any shape.
double gamma_amplitude_variation(double shape);

/// Correlation of ln P at two places whose complex amplitudes have the squared correlation `k2`.
/// Laguerre polynomials diagonalise the joint density of both powers (Kibble's bivariate gamma)
/// with the factors k2^j, and ln P has the coefficient -1 / j. So the covariance is sum k2^j / (j^2
/// h_j), h_j = binomial(n + j - 1, j); for one look that is the dilogarithm of k2.
double log_power_correlation(double k2, int looks);

/// These numbers for one receiver.
struct LogStatistics {
    int looks = 1;
    double mean = 0.0, variance = 0.0, skewness = 0.0;
    double variation = 0.0;  ///< coefficient for the amplitude
    /// The correlations at even steps of k2 from 0 to 1, less those of `looks` alone.
    std::vector<double> excess;

    double correlation(double k2) const;
};

/// The numbers of a receiver that delivers each sample.
LogStatistics log_statistics(int looks);

}  // namespace sonarsim
