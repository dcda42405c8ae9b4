#pragma once

#include <complex>
#include <span>
#include <vector>

namespace sonarsim {

/// A stage of the receiver of an EK80: a filter, behind which one of `decimation` samples is kept.
struct EkFilter {
    int decimation = 1;
    std::vector<std::complex<float>> taps;
};

/// A transmitted sweep of an EK80.
struct EkSweep {
    double start_hz = 0.0;
    double end_hz = 0.0;
    double duration_s = 0.0;
    double slope = 0.0;     ///< share of the duration in which the envelope rises, and falls
    double sample_s = 0.0;  ///< interval of the samples behind all filters

    bool operator==(const EkSweep&) const = default;
};

/// Adds to the products of all filters of a file. Throws std::runtime_error where they would take
/// more than some twenty seconds.
void add_products(std::size_t more, std::size_t& products);

/// The sweep as it comes out of the receiver's filters. The samples before the first filter are as
/// many times denser as its stages keep fewer. Throws std::runtime_error for impossible numbers.
std::vector<std::complex<double>> filtered_sweep(const EkSweep& sweep,
                                                 const std::vector<EkFilter>& filters,
                                                 std::size_t& products);

/// The matched filter: samples correlated with a pulse over the pulse's energy. An echo with the
/// amplitude of the pulse becomes 1 where it begins.
std::vector<std::complex<double>> compressed(std::span<const std::complex<double>> samples,
                                             std::span<const std::complex<double>> pulse);

}  // namespace sonarsim
