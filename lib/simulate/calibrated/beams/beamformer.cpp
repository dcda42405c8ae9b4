#include "simulate/calibrated/beams/beamformer.h"

#include <immintrin.h>

#include <algorithm>
#include <utility>

#include "core/elementary.h"
#include "core/units.h"
#include "simulate/calibrated/signal/directivity.h"

namespace sonarsim {

namespace {

// Columns outside the outer beams, for echoes at the view's edge and for interpolation.
constexpr int margin = 5;
// Free columns after the last one, so that an outer beam in focus does not wrap to the other side.
constexpr int gap = 12;

/// The share of [at - 1/2, at + 1/2] steps that lies within [-half, half] steps.
double covered(double at, double half) {
    const double low = std::max(at - 0.5, -half);
    const double high = std::min(at + 0.5, half);
    return std::max(high - low, 0.0);
}

using Complexes = std::vector<std::complex<double>>;

/// The weights of the elements -reach to reach. Their transform is the array's pattern.
Complexes element_weights(const LineArray& array, double elements) {
    const int reach = static_cast<int>(std::ceil(0.5 * elements - 0.5));
    Complexes out;
    for (int k = -reach; k <= reach; ++k) {
        const double share = covered(k, 0.5 * elements);
        // An element at the end has the weight of its part within the aperture.
        const double x = std::clamp(k / elements, -0.5, 0.5);
        out.push_back(array.weight(x) * (share / elements));
    }
    return out;
}

/// Applies the errors of the array's elements. The mean side lobe is the errors' variance divided
/// by the number of elements, so it is scaled from elements to samples of the aperture.
void add_element_errors(const LineArray& array, const ElementsConfig& elements, double samples,
                        Complexes& weights) {
    if (!elements.exist()) return;
    const double scale = std::sqrt(samples / element_count(array));
    const Complexes errors = element_errors(elements, static_cast<int>(weights.size()));
    for (std::size_t k = 0; k < weights.size(); ++k)
        weights[k] *= 1.0 + scale * errors[k];
}

/// The weights of the squared pattern: the weights correlated with themselves. Without the checks
/// for NaN of products of std::complex, which take most of the time.
Complexes correlated(const Complexes& weights) {
    const std::size_t n = weights.size();
    Complexes out(2 * n - 1);
    for (std::size_t lag = 0; lag < n; ++lag) {
        double re = 0.0;
        double im = 0.0;
        for (std::size_t k = 0; k + lag < n; ++k) {
            const std::complex<double> a = weights[k + lag];
            const std::complex<double> b = weights[k];
            re += a.real() * b.real() + a.imag() * b.imag();
            im += a.imag() * b.real() - a.real() * b.imag();
        }
        out[n - 1 + lag] = {re, im};
        out[n - 1 - lag] = {re, -im};
    }
    return out;
}

/// The weights of the squared pattern, of at most `most` elements, or of the pattern.
Complexes weights_of_form(Complexes weights, bool powers, int max_size) {
    if (!powers) return weights;
    weights = correlated(weights);
    const int excess = (static_cast<int>(weights.size()) - max_size + 1) / 2;
    return excess > 0 ? Complexes(weights.begin() + excess, weights.end() - excess) : weights;
}

/// The columns by which beams out of focus are wider, to either side: the phase q (2 x)^2 over an
/// aperture of W wavelengths turns by the sine 2 q / (pi W) at its ends.
int columns_by_defocus(const LineArray& array, double step, std::span<const double> defocus_rad) {
    double largest = 0.0;
    for (const double phase : defocus_rad)
        largest = std::max(largest, std::fabs(phase));
    return static_cast<int>(std::ceil(2.0 * largest / (pi * array.wavelengths * step)));
}

/// Kaiser's window, to -60 dB, at x in [-1, 1].
double window(double x) {
    const auto bessel = [](double y) {
        double term = 1.0;
        double sum = 1.0;
        for (int k = 1; k < 30; ++k) {
            term *= 0.25 * y * y / (static_cast<double>(k) * k);
            sum += term;
        }
        return sum;
    };
    constexpr double shape = 6.0;
    return bessel(shape * std::sqrt(std::max(1.0 - x * x, 0.0))) / bessel(shape);
}

/// The complex numbers of 8 bins of a column: real parts and imaginary parts.
void load_bins(const float* bins, ComplexLanes& out) {
    const __m256 low = _mm256_loadu_ps(bins);
    const __m256 high = _mm256_loadu_ps(bins + lanes);
    const __m256 first = _mm256_permute2f128_ps(low, high, 0x20);
    const __m256 second = _mm256_permute2f128_ps(low, high, 0x31);
    _mm256_store_ps(out.re.data(), _mm256_shuffle_ps(first, second, _MM_SHUFFLE(2, 0, 2, 0)));
    _mm256_store_ps(out.im.data(), _mm256_shuffle_ps(first, second, _MM_SHUFFLE(3, 1, 3, 1)));
}

ComplexLanes interpolated(const ComplexLanes* columns, const float* taps, int count) {
    ComplexLanes sum{};
    for (int t = 0; t < count; ++t) {
        const ComplexLanes z = columns[t];
        const float tap = taps[t];
        for (int lane = 0; lane < lanes; ++lane) {
            sum.re[lane] = std::fma(tap, z.re[lane], sum.re[lane]);
            sum.im[lane] = std::fma(tap, z.im[lane], sum.im[lane]);
        }
    }
    return sum;
}

}  // namespace

SineGrid sine_grid(const LineArray& array, const std::vector<double>& beam_sines) {
    const double low = *std::ranges::min_element(beam_sines);
    const double high = *std::ranges::max_element(beam_sines);
    const auto beams = static_cast<int>(beam_sines.size());
    SineGrid grid;
    grid.step = 1.0 / (3.0 * array.wavelengths);
    // Equally spaced beams lie on columns, if these are fine enough: widths are right to 3 %.
    const double spacing = beams > 1 ? (high - low) / (beams - 1) : 0.0;
    bool even = beams > 1;
    for (int j = 0; j < beams; ++j)
        even = even && std::fabs(beam_sines[j] - (low + spacing * j)) < 1e-6 * spacing;
    if (even) {
        const double parts = std::ceil(spacing * array.wavelengths / 0.35);
        grid.step = spacing / parts;
    }
    grid.first = low - margin * grid.step;
    grid.columns = static_cast<int>(std::ceil((high - low) / grid.step - 1e-6)) + 1 + 2 * margin;
    return grid;
}

Beamformer::Beamformer(const LineArray& array, const std::vector<double>& beam_sines, bool powers,
                       const ElementsConfig& element_errors, std::span<const double> defocus_rad)
    : powers_(powers),
      grid_(sine_grid(array, beam_sines)),
      fourier_(transform_size(grid_.columns + gap +
                              columns_by_defocus(array, grid_.step, defocus_rad))) {
    const int size = fourier_.size();
    const double elements = std::min(size * grid_.step * array.wavelengths, size - 1.0);
    LineArray own = array;
    if (defocus_rad.empty()) add_weights(own, elements, element_errors);
    for (const double phase : defocus_rad) {
        own.quadratic_rad = array.quadratic_rad + phase;
        add_weights(own, elements, element_errors);
    }
    find_taps(beam_sines);
}

/// Adds the weights of a block of rows; `samples` of the aperture. The gain and the sigma of
/// amplitudes are those of every block, since blocks differ by phases alone.
void Beamformer::add_weights(const LineArray& array, double samples,
                             const ElementsConfig& element_errors) {
    const int size = fourier_.size();
    Complexes weights = element_weights(array, samples);
    add_element_errors(array, element_errors, samples, weights);
    weights = weights_of_form(std::move(weights), powers_, size);
    elements_ = static_cast<int>(weights.size());
    const int reach = elements_ / 2;
    const std::size_t first = weights_.size();
    double in_columns = 0.0;
    double between = 0.0;
    double noise = 0.0;
    for (int k = -reach; k <= reach; ++k) {
        // The weight undoes the triangle's transform by which columns share an echo.
        const double triangle = sinc(static_cast<double>(k) / size);
        const std::complex<double> weight = weights[k + reach] / (triangle * triangle);
        weights_.push_back({.re = static_cast<float>(weight.real()),
                            .im = static_cast<float>(weight.imag()),
                            .index = (k + size) % size,
                            .noise_scale = static_cast<float>(triangle * triangle)});
        noise += std::norm(weights[k + reach]);
        in_columns += std::norm(weight);
        between += std::norm(weight) * (2.0 + sincos(2.0 * pi * k / size).cos) / 3.0;
    }
    scalloping_gain_ = static_cast<float>(between / in_columns);
    // Amplitudes between columns: the mean power over all positions becomes that of the pattern.
    const auto level = static_cast<float>(powers_ ? 1.0 : std::sqrt(noise / between));
    for (Weight& weight : std::span(weights_).subspan(first)) {
        weight.re *= level;
        weight.im *= level;
        weight.noise_scale /= level;
    }
    // The power of noise in a beam is the sum over elements and both parts.
    unit_sigma_ = static_cast<float>(std::sqrt(0.5 / noise));
}

void Beamformer::find_taps(const std::vector<double>& beam_sines) {
    bool on_columns = true;
    for (const double sine : beam_sines) {
        const double at = (sine - grid_.first) / grid_.step;
        on_columns = on_columns && std::fabs(at - std::round(at)) < 1e-4;
    }
    taps_ = on_columns ? 1 : max_taps;
    for (const double sine : beam_sines) {
        const double at = (sine - grid_.first) / grid_.step;
        const int first = on_columns ? static_cast<int>(std::round(at))
                                     : static_cast<int>(std::floor(at)) - max_taps / 2 + 1;
        first_tap_.push_back(first);
        double sum = 0.0;
        std::vector<double> taps;
        for (int t = 0; t < taps_; ++t) {
            const double distance = first + t - at;
            taps.push_back(on_columns ? 1.0 : sinc(distance) * window(distance / (0.5 * max_taps)));
            sum += taps.back();
        }
        for (const double tap : taps)
            tap_.push_back(static_cast<float>(tap / sum));
    }
}

ElementNoise Beamformer::noise_of_ping(std::span<const float> row_sigma,
                                       const std::vector<float>& taps, PhiloxKey key) const {
    // One counter serves two elements.
    const int pairs = (elements_ + 1) / 2;
    const NoiseChannels channels{.firsts = pairs, .seconds = elements_ - pairs};
    return {.row_sigma = row_sigma, .drawn = FilteredNoise(channels, taps, key)};
}

/// Adds the noise of the bins `row` to `row` + 7.
void Beamformer::add_noise(ElementNoise& noise, int row, Scratch& scratch) const {
    noise.drawn.go_to(row);
    const float* const row_sigma = noise.row_sigma.data() + row;
    const std::span<const Weight> weights = weights_at(row);
    for (int e = 0; e < elements_; ++e) {
        const ComplexLanes drawn = noise.drawn.of(e);
        ComplexLanes z = scratch.data[weights[e].index];
        const float scale = weights[e].noise_scale;
        for (int lane = 0; lane < lanes; ++lane) {
            const float sigma = row_sigma[lane] * scale;
            z.re[lane] = std::fma(sigma, drawn.re[lane], z.re[lane]);
            z.im[lane] = std::fma(sigma, drawn.im[lane], z.im[lane]);
        }
        scratch.data[weights[e].index] = z;
    }
}

void Beamformer::form(const EchoGrid* grid, int row, ElementNoise* noise, Scratch& scratch,
                      Lanes* out) const {
    ComplexLanes* const data = scratch.data.data();
    const int size = fourier_.size();
    if (grid) {
        for (int c = 0; c < grid_.columns; ++c)
            load_bins(grid->column(c) + static_cast<std::ptrdiff_t>(2) * row, data[c]);
        std::fill(data + grid_.columns, data + size, ComplexLanes{});
        fourier_.forward(data, scratch.spare.data());
    } else {
        std::fill(data, data + size, ComplexLanes{});
    }
    if (noise) add_noise(*noise, row, scratch);

    // The transform has more elements than the aperture; the others receive nothing.
    const int reach = elements_ / 2;
    std::fill(data + reach + 1, data + size - reach, ComplexLanes{});
    for (const Weight& w : weights_at(row)) {
        const ComplexLanes z = data[w.index];
        const float re = w.re;
        const float im = w.im;
        ComplexLanes weighted;
        for (int lane = 0; lane < lanes; ++lane) {
            weighted.re[lane] = z.re[lane] * re - z.im[lane] * im;
            weighted.im[lane] = z.re[lane] * im + z.im[lane] * re;
        }
        data[w.index] = weighted;
    }
    fourier_.backward(data, scratch.spare.data());

    for (int j = 0; j < beams(); ++j) {
        const ComplexLanes* const from = data + first_tap_[j];
        const float* const tap = tap_.data() + static_cast<std::ptrdiff_t>(j) * taps_;
        ComplexLanes z = taps_ == 1 ? from[0] : interpolated(from, tap, taps_);
        for (int lane = 0; lane < lanes; ++lane) {
            const float power = std::fma(z.re[lane], z.re[lane], z.im[lane] * z.im[lane]);
            out[j][lane] = powers_ ? std::max(z.re[lane], 0.0F) : power;
        }
    }
}

}  // namespace sonarsim
