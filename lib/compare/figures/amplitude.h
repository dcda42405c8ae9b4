#pragma once

#include <span>

namespace sonarsim {

// Statistics of the amplitudes of homogeneous patches, as pure functions of arrays. Amplitudes of
// developed speckle are Rayleigh distributed: coefficient of variation 0.5227, Weibull shape 2,
// inverse K shape 0, spread 5.57 dB.

/// The mean, the standard deviation over it, and the third standardised moment.
struct AmplitudeMoments {
    double mean = 0.0;
    double variation = 0.0;
    double skewness = 0.0;
};
AmplitudeMoments amplitude_moments(std::span<const float> amplitudes);

/// The variance of the powers A^2 over the square of their mean: 1 for developed speckle.
double scintillation(std::span<const float> amplitudes);

/// The maximum-likelihood shape k of the Weibull distribution of the amplitudes above 0, within 0.2
/// and 12: the root of sum(v^k ln v) / sum(v^k) - 1/k - mean(ln v). NaN where fewer than two
/// amplitudes differ.
double weibull_shape(std::span<const float> amplitudes);

/// 1/nu of K-distributed amplitudes of `looks` looks, by Blacknell and Tough's moment
/// E[I ln I] / E[I] - E[ln I] = 1/looks + 1/nu of the powers I. By chance it may be slightly
/// negative for Rayleigh amplitudes.
double inverse_k_shape(std::span<const float> amplitudes, double looks = 1.0);

/// The standard deviation of the level of the amplitudes above 0, dB.
double spread_db(std::span<const float> amplitudes);

}  // namespace sonarsim
