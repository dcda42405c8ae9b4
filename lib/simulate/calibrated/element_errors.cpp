#include "simulate/calibrated/element_errors.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/normal_pair.h"
#include "core/random.h"
#include "core/units.h"
#include "simulate/calibrated/decibel.h"
#include "simulate/calibrated/directivity.h"

namespace sonarsim {

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

}  // namespace sonarsim
