#include "simulate/calibrated/signal/near_field.h"

#include <cmath>

#include "core/elementary.h"
#include "core/units.h"
#include "simulate/calibrated/signal/fourier.h"

namespace sonarsim {

namespace {

// Change of the phase at the ends of the array from one entry to the next, rad.
constexpr double phase_by_entry = 0.3;

/// The phase at the ends of the array at curvature 1, rad.
double end_phase(const LineArray& array, double wavelength_m) {
    return 0.25 * pi * array.wavelengths * array.wavelengths * wavelength_m;
}

/// The number of steps along the array, so that the phase turns by less than a quarter of a radian
/// in each.
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
