#include "simulate/calibrated/signal/directivity.h"

#include <algorithm>

#include "core/decibel.h"
#include "core/elementary.h"
#include "core/random.h"
#include "core/units.h"

namespace sonarsim {

namespace {

/// The vertical side of a transmitter or a receiver, by the width of both together.
LineArray one_way_elevation(const BeamConfig& beam) {
    return line_array(std::sqrt(2.0) * radians(beam.elevation_width_deg), 0.0);
}

/// The integral of the pattern of an array over the sine of the angle.
double equivalent_sine(const LineArray& array) {
    return taper_loss(array) / array.wavelengths;
}

constexpr double half_power_at = 1.616339948;

}  // namespace

std::vector<std::complex<double>> element_errors(const ElementsConfig& elements, int count) {
    const PhiloxKey key{static_cast<std::uint32_t>(elements.serial),
                        number_of_name("element errors")};
    std::vector<std::complex<double>> out;
    out.reserve(count);
    for (int n = 0; n < count; ++n) {
        const PhiloxBlock draw = philox({static_cast<std::uint32_t>(n), 1, 0, 0}, key);
        const NormalPair normals = normal_pair(draw.x0);
        const double gain = power_of_db(0.5 * elements.gain_error_db * normals.first);
        const SinCos phase = sincos(radians(elements.phase_error_deg) * normals.second);
        out.emplace_back(gain * phase.cos - 1.0, gain * phase.sin);
    }
    return out;
}

double element_count(const LineArray& array) {
    return std::max(1.0, std::round(2.0 * array.wavelengths));
}

double mean_side_lobe(const LineArray& array, const ElementsConfig& elements) {
    const double gain = 0.05 * ln_10 * elements.gain_error_db;
    const double phase = radians(elements.phase_error_deg);
    return (gain * gain + phase * phase) * taper_loss(array) / element_count(array);
}

PatternWithErrors::PatternWithErrors(const LineArray& array, const ElementsConfig& elements)
    : array_(array) {
    if (!elements.exist()) return;
    const double count = element_count(array);
    errors_ = element_errors(elements, static_cast<int>(count));
    for (std::size_t n = 0; n < errors_.size(); ++n) {
        const double x = (static_cast<double>(n) + 0.5) / count - 0.5;
        errors_[n] = array.weight(x) * errors_[n];
    }
}

std::complex<double> PatternWithErrors::operator()(double u) const {
    const double pattern = line_pattern(array_, u);
    if (errors_.empty()) return pattern;
    const auto count = static_cast<double>(errors_.size());
    std::complex<double> sum = 0.0;
    for (std::size_t n = 0; n < errors_.size(); ++n) {
        const double x = (static_cast<double>(n) + 0.5) / count - 0.5;
        const SinCos phase = sincos(2.0 * pi * array_.wavelengths * x * u);
        sum += errors_[n] * std::complex<double>(phase.cos, phase.sin);
    }
    return pattern + sum / count;
}

double taper_loss(const LineArray& array) {
    // w = p + (1 - p) cos^2: the means of cos^2 and cos^4 are 1/2 and 3/8.
    const double p = array.pedestal;
    const double q = 1.0 - p;
    const double mean = p + 0.5 * q;
    return (p * p + p * q + 0.375 * q * q) / (mean * mean);
}

double line_directivity(const LineArray& array) {
    return 2.0 / equivalent_sine(array);
}

double rectangle_directivity(const LineArray& along, const LineArray& across) {
    return 4.0 * pi / (equivalent_sine(along) * equivalent_sine(across));
}

double piston_directivity(double width_rad) {
    const double circumference = piston_scale(width_rad);  // pi D / lambda
    return circumference * circumference;
}

double receiving_directivity(const BeamConfig& beam) {
    if (beam.aperture == Aperture::piston) return piston_directivity(radians(beam.width_deg));
    const LineArray along = line_array(radians(beam.width_deg), beam.side_lobe_db);
    if (beam.aperture == Aperture::port_starboard)
        return rectangle_directivity(along, line_array(radians(beam.across_width_deg), 0.0));
    if (beam.elevation_width_deg <= 0.0) return line_directivity(along);
    return rectangle_directivity(along, one_way_elevation(beam));
}

double transmitting_directivity(const BeamConfig& beam, const View& view) {
    if (beam.aperture != Aperture::line) return receiving_directivity(beam);
    const double sines = beam.elevation_width_deg > 0.0 ? equivalent_sine(one_way_elevation(beam))
                                                        : 2.0;  // elevations from -90 to 90 degrees
    return 4.0 * pi / (view.azimuth_rad * sines);
}

double piston_pattern(double x) {
    // Poisson's integral: 2 J1(x) / x = 2 / pi times the integral of sin^2(t) cos(x cos t) over
    // half a turn. The sum over equal steps is exact once there are more of them than radians in x.
    const int steps = 24 + static_cast<int>(std::fabs(x));
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const SinCos t = sincos(pi * (k + 0.5) / steps);
        sum += t.sin * t.sin * sincos(x * t.cos).cos;
    }
    return 2.0 * sum / steps;
}

double piston_scale(double width_rad) {
    return half_power_at / sincos(0.5 * width_rad).sin;
}

}  // namespace sonarsim
