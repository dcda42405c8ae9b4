#include "format/ek80_pulse.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

using Complex = std::complex<double>;

// Real pulses last up to 16 ms at 1.5 MHz; real receivers have two filters of up to some hundred
// taps.
constexpr double most_pulse_samples = 1e5;
constexpr std::size_t most_taps = 4096;
constexpr std::size_t most_filters = 8;
// A real file of 1 GB takes this many: 3e7 samples of four sectors, pulses of 300 samples.
constexpr std::size_t most_products = 10'000'000'000;

/// Adds a * b to `sum`. The product of std::complex is slower: it checks for infinities.
void add_product(const Complex& a, const Complex& b, Complex& sum) {
    sum += Complex(a.real() * b.real() - a.imag() * b.imag(),
                   a.real() * b.imag() + a.imag() * b.real());
}

/// The convolution of a signal with a filter; one in `decimation` samples is kept.
std::vector<Complex> filtered(const std::vector<Complex>& signal, const EkFilter& filter) {
    std::vector<Complex> out;
    const std::size_t taps = filter.taps.size();
    for (std::size_t i = 0; i < signal.size() + taps - 1;
         i += static_cast<std::size_t>(filter.decimation)) {
        Complex sum = 0.0;
        const std::size_t first = i + 1 > signal.size() ? i + 1 - signal.size() : 0;
        for (std::size_t k = first; k < std::min(taps, i + 1); ++k)
            add_product(Complex(filter.taps[k]), signal[i - k], sum);
        out.push_back(sum);
    }
    return out;
}

}  // namespace

void add_products(std::size_t more, std::size_t& products) {
    products += more;
    if (products > most_products)
        throw std::runtime_error(
            "has sweeps or filters too long for its samples; take fewer pings");
}

std::vector<Complex> filtered_sweep(const EkSweep& sweep, const std::vector<EkFilter>& filters,
                                    std::size_t& products) {
    if (filters.size() > most_filters)
        throw std::runtime_error("has more than 8 filters (FIL1 datagrams) of a channel");
    double step_s = sweep.sample_s;
    for (const EkFilter& filter : filters) {
        if (filter.decimation < 1 || filter.taps.empty() || filter.taps.size() > most_taps)
            throw std::runtime_error("has a filter (FIL1 datagram) with impossible numbers");
        step_s /= filter.decimation;
    }
    const double count = std::floor(sweep.duration_s / step_s + 1e-6);
    if (!(count >= 1.0 && count <= most_pulse_samples) ||
        !(sweep.slope >= 0.0 && sweep.slope <= 0.5) ||
        !(std::fabs(sweep.start_hz) + std::fabs(sweep.end_hz) < 1e8))
        throw std::runtime_error("has a sweep with impossible numbers");
    std::vector<Complex> signal;
    const double rise_s = sweep.slope * sweep.duration_s;
    for (int k = 0; k < static_cast<int>(count); ++k) {
        const double t = k * step_s;
        const double to_edge = std::min(t, sweep.duration_s - t);
        const double envelope =
            to_edge < rise_s ? 0.5 - 0.5 * sincos(pi * to_edge / rise_s).cos : 1.0;
        const double share = t / sweep.duration_s;
        const double mean_hz = sweep.start_hz + 0.5 * share * (sweep.end_hz - sweep.start_hz);
        signal.emplace_back(envelope * sincos(2.0 * pi * t * mean_hz).cos);
    }
    for (const EkFilter& filter : filters) {
        const std::size_t all = signal.size() + filter.taps.size();
        add_products(filter.taps.size() * (all / static_cast<std::size_t>(filter.decimation) + 1),
                     products);
        signal = filtered(signal, filter);
    }
    return signal;
}

std::vector<Complex> compressed(std::span<const Complex> samples, std::span<const Complex> pulse) {
    double energy = 0.0;
    for (const Complex& value : pulse)
        energy += std::norm(value);
    if (!(energy > 0.0)) throw std::runtime_error("has filters that leave nothing of its sweep");
    std::vector<Complex> out;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        Complex sum = 0.0;
        for (std::size_t k = 0; k < std::min(pulse.size(), samples.size() - i); ++k)
            add_product(std::conj(pulse[k]), samples[i + k], sum);
        out.push_back(sum / energy);
    }
    return out;
}

}  // namespace sonarsim
