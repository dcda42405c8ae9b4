#include "simulate/calibrated/signal/line_array.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/elementary.h"
#include "core/units.h"
#include "simulate/calibrated/signal/decibel.h"

namespace sonarsim {

namespace {

/// The pattern of any pedestal at one t: the parts of the uniform weight and of the cosine, each of
/// unit weight.
struct PatternParts {
    double even, cosine;

    double at(double pedestal) const {
        return (pedestal * even + (1.0 - pedestal) * cosine) / (0.5 * (1.0 + pedestal));
    }
};

PatternParts pattern_parts(double t) {
    return {sinc(t), 0.5 * (sinc(t) + 0.5 * (sinc(t + 1.0) + sinc(t - 1.0)))};
}

double pattern(double pedestal, double t) {
    return pattern_parts(t).at(pedestal);
}

/// The pattern from t = 1 to 5, which contains its highest side lobe: the main lobe ends between 1
/// and 2, and side lobes fall soon after.
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
        const double value = pattern(pedestal, middle);
        (value * value > 0.5 ? low : high) = middle;
    }
    return low;
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
    return pattern(array.pedestal, u * array.wavelengths);
}

LineArray line_array(double width_rad, double side_lobe_db) {
    const double wanted = power_of_db(side_lobe_db);
    const std::vector<PatternParts> parts = side_lobe_parts();
    // Below a pedestal of 0.08 (Hamming's) the far side lobes take over from the first.
    double low = 0.08;
    double high = 1.0;
    for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (side_lobe(parts, middle) > wanted ? high : low) = middle;
    }
    LineArray array;
    array.pedestal = side_lobe_db >= -13.27 ? 1.0 : low;
    array.wavelengths = half_power(array.pedestal) / sincos(0.5 * width_rad).sin;
    return array;
}

}  // namespace sonarsim
