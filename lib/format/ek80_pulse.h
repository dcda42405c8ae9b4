#pragma once

#include <complex>
#include <span>
#include <vector>

namespace sonarsim {

/// A stage of an EK80's receiver: a filter, after which one in `decimation` samples is kept.
struct EkFilter {
    int decimation = 1;
    std::vector<std::complex<float>> taps;
};

/// A transmitted sweep of an EK80.
struct EkSweep {
    double start_hz = 0.0;
    double end_hz = 0.0;
    double duration_s = 0.0;
    double slope = 0.0;     ///< rise time of the envelope / duration; the fall takes as long
    double sample_s = 0.0;  ///< sample interval after all filters

    bool operator==(const EkSweep&) const = default;
};

/// Counts the multiplications of a file's filters. Throws std::runtime_error if they would take
/// more than about twenty seconds.
void add_products(std::size_t more, std::size_t& products);

/// The sweep after the receiver's filters. Before the first filter the samples are denser by the
/// product of all decimations. Throws std::runtime_error for impossible numbers.
std::vector<std::complex<double>> filtered_sweep(const EkSweep& sweep,
                                                 const std::vector<EkFilter>& filters,
                                                 std::size_t& products);

/// The matched filter: samples correlated with a pulse over the pulse's energy. An echo with the
/// amplitude of the pulse becomes 1 where it begins.
std::vector<std::complex<double>> compressed(std::span<const std::complex<double>> samples,
                                             std::span<const std::complex<double>> pulse);

}  // namespace sonarsim
