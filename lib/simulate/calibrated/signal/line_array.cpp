#include "simulate/calibrated/signal/line_array.h"

#include <span>

#include "core/decibel.h"
#include "core/elementary.h"
#include "core/units.h"
#include "simulate/calibrated/signal/fourier.h"

namespace sonarsim {

namespace {

/// The pattern of any pedestal at one t: parts of the uniform weight and of the cosine, unweighted.
struct PatternParts {
    double even, cosine;

    double at(double pedestal) const {
        return (pedestal * even + (1.0 - pedestal) * cosine) / (0.5 * (1.0 + pedestal));
    }
};

PatternParts pattern_parts(double t) {
    return {sinc(t), 0.5 * (sinc(t) + 0.5 * (sinc(t + 1.0) + sinc(t - 1.0)))};
}

/// The pattern from t = 1 to 5, which has the highest side lobe: the main lobe ends below 2.
std::vector<PatternParts> side_lobe_parts() {
    std::vector<PatternParts> out;
    for (int k = 200; k <= 1000; ++k)
        out.push_back(pattern_parts(0.005 * k));
    return out;
}

/// The highest side lobe, as a ratio of powers.
double side_lobe(std::span<const PatternParts> parts, double pedestal) {
    double highest = 0.0;
    double last = 1.0;
    bool past_null = false;
    for (const PatternParts& part : parts) {
        const double value = part.at(pedestal);
        past_null = past_null || value * last <= 0.0;
        if (past_null) highest = std::max(highest, value * value);
        last = value;
    }
    return highest;
}

/// t at which the power is halved.
double half_power(double pedestal) {
    double low = 0.0;
    double high = 1.0;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        const double value = pattern_parts(middle).at(pedestal);
        (value * value > 0.5 ? low : high) = middle;
    }
    return low;
}

// Change of the phase at the ends of the array from one entry to the next, rad.
constexpr double phase_by_entry = 0.3;

/// The phase at the ends of the array at curvature 1, rad.
double end_phase(const LineArray& array, double wavelength_m) {
    return 0.25 * pi * array.wavelengths * array.wavelengths * wavelength_m;
}

/// The number of steps along the array, each with less than a quarter of a radian of phase.
int steps_for(double bend, double turn) {
    return 32 + static_cast<int>(4.0 * (std::fabs(bend) + std::fabs(turn)));
}

/// Fills the table by Fourier transforms over the array, of several curvatures at once. The sines
/// are those of the transform. `bend` is the phase of the last curvature, `turn` that of the
/// greatest sine, `half` the least number of sines on a side.
void fill_by_transforms(const LineArray& array, double bend, double turn, int half,
                        UnfocusedBeam& out) {
    const int steps = 2 * (steps_for(bend, turn) / 4);
    const Fourier fourier(
        transform_size(static_cast<int>(std::ceil(2.0 * pi * half / turn * steps))));
    const int size = fourier.size();
    const double turn_by_sine = 2.0 * pi * steps / size;
    const double sine_step = turn_by_sine / (2.0 * pi * array.wavelengths);
    const int count = static_cast<int>(std::ceil(turn / turn_by_sine - 1e-9));
    out.sines = 2 * count + 1;
    out.greatest_sine = static_cast<float>(count * sine_step);
    out.sines_per_unit = static_cast<float>(1.0 / sine_step);
    out.values.resize(static_cast<std::size_t>(out.sines) * out.curvatures);
    std::vector<ComplexLanes> data(size), spare(size);
    for (int first = 0; first < out.curvatures; first += lanes) {
        std::ranges::fill(data, ComplexLanes{});
        for (int k = 0; k < steps / 2; ++k) {
            const double x = (k + 0.5) / steps;
            const double weight = array.weight(x).real() / steps;
            ComplexLanes& value = data[k];
            for (int lane = 0; lane < lanes; ++lane) {
                const SinCos phase = sincos(bend * (first + lane) / (out.curvatures - 1) * x * x);
                value.re[lane] = static_cast<float>(weight * phase.cos);
                value.im[lane] = static_cast<float>(weight * phase.sin);
            }
            data[size - 1 - k] = value;  // at -x
        }
        fourier.forward(data.data(), spare.data());
        const int filled = std::min(lanes, out.curvatures - first);
        for (int i = 0; i <= count; ++i) {
            // The middles of steps lie half a step off those of the transform.
            const SinCos off = sincos(-0.5 * turn_by_sine * i / steps);
            const std::complex<float> shift(static_cast<float>(off.cos),
                                            static_cast<float>(off.sin));
            for (int lane = 0; lane < filled; ++lane) {
                const std::complex<float> one_way =
                    shift * std::complex<float>(data[i].re[lane], data[i].im[lane]);
                std::complex<float>* const middle =
                    out.values.data() + static_cast<std::ptrdiff_t>(first + lane) * out.sines +
                    count;
                middle[i] = one_way * one_way;
                middle[-i] = middle[i];
            }
        }
    }
}

}  // namespace

std::complex<double> LineArray::weight(double x) const {
    if (std::fabs(x) > 0.5) return 0.0;
    const double cosine = sincos(pi * x).cos;
    const double amplitude =
        (pedestal + (1.0 - pedestal) * cosine * cosine) / (0.5 * (1.0 + pedestal));
    const double y = 2.0 * x;
    const SinCos phase = sincos(y * y * (quadratic_rad + y * (cubic_rad + y * quartic_rad)));
    return {amplitude * phase.cos, amplitude * phase.sin};
}

double line_pattern(const LineArray& array, double u) {
    return pattern_parts(u * array.wavelengths).at(array.pedestal);
}

LineArray line_array(double width_rad, double side_lobe_db) {
    const double wanted = power_of_db(side_lobe_db);
    static const std::vector<PatternParts> parts = side_lobe_parts();
    // Below a pedestal of 0.08 (Hamming's) the far side lobes take over from the first.
    double low = 0.08;
    double high = 1.0;
    const bool is_uniform = side_lobe_db >= -13.27;
    for (int k = 0; !is_uniform && k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (side_lobe(parts, middle) > wanted ? high : low) = middle;
    }
    LineArray array;
    array.pedestal = is_uniform ? 1.0 : low;
    array.wavelengths = half_power(array.pedestal) / sincos(0.5 * width_rad).sin;
    return array;
}

std::complex<double> unfocused_pattern(const LineArray& array, double u, double wavelength_m,
                                       double curvature_per_m) {
    const double bend = 4.0 * end_phase(array, wavelength_m) * curvature_per_m;
    const double turn = 2.0 * pi * array.wavelengths * u;
    const int steps = steps_for(bend, turn);
    std::complex<double> sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double x = (k + 0.5) / steps - 0.5;
        const SinCos phase = sincos(x * (turn - bend * x));
        sum += array.weight(x) * std::complex<double>(phase.cos, -phase.sin);
    }
    return sum / static_cast<double>(steps);
}

UnfocusedBeam unfocused_beam(const LineArray& array, double wavelength_m, double range_min_m,
                             double greatest_sine) {
    const double nearest = std::max(range_min_m, array.wavelengths * wavelength_m);
    const double turn = 2.0 * pi * array.wavelengths * greatest_sine;
    const double bend = 4.0 * end_phase(array, wavelength_m) / nearest;
    UnfocusedBeam out;
    out.max_curvature = static_cast<float>(1.0 / nearest);
    const auto entries = [](double phase) { return 2 + static_cast<int>(phase / phase_by_entry); };
    const int half = (entries(turn) + 1) / 2;
    out.curvatures = 1 + entries(0.25 * bend);
    out.curvatures_per_unit = static_cast<float>((out.curvatures - 1) * nearest);

    fill_by_transforms(array, bend, turn, half, out);
    return out;
}

}  // namespace sonarsim
