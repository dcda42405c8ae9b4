#include "simulate/calibrated/clutter.h"

#include <cmath>

#include "core/elementary.h"
#include "core/log_gamma.h"

namespace sonarsim {

namespace {

/// The regularised lower incomplete gamma function P(a, x), by its series or its continued fraction
/// (e.g. Abramowitz and Stegun 6.5.29 and 6.5.31). `log_gamma` is ln Gamma(a).
double gamma_probability(double a, double x, double log_gamma) {
    if (x <= 0.0) return 0.0;
    const double factor = exponential(a * logarithm(x) - x - log_gamma);
    if (x < a + 1.0) {
        double term = 1.0 / a;
        double sum = term;
        for (int n = 1; n < 500; ++n) {
            term *= x / (a + n);
            sum += term;
        }
        return factor * sum;
    }
    double tail = 0.0;
    for (int n = 200; n >= 1; --n)
        tail = n * (n - a) / (x + 2.0 * n + 1.0 - a - tail);
    return 1.0 - factor / (x + 1.0 - a - tail);
}

}  // namespace

Clutter gamma_clutter(double shape, double edge_m) {
    Clutter out;
    if (shape <= 0.0) return out;
    out.edge_m = static_cast<float>(edge_m);
    const double log_gamma_of_shape = log_gamma(shape);
    double mean = 0.0;
    for (int k = 0; k < Clutter::steps; ++k) {
        const double probability = (k + 0.5) / Clutter::steps;
        double low = 0.0;
        double high = shape + 40.0 * std::sqrt(shape) + 40.0;
        for (int n = 0; n < 60; ++n) {
            const double middle = 0.5 * (low + high);
            const bool below = gamma_probability(shape, middle, log_gamma_of_shape) < probability;
            (below ? low : high) = middle;
        }
        out.strength.push_back(static_cast<float>(low));
        mean += low / Clutter::steps;
    }
    for (float& strength : out.strength)
        strength = static_cast<float>(strength / mean);
    return out;
}

}  // namespace sonarsim
