#include "simulate/calibrated/piston.h"

#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

constexpr double half_power_at = 1.616339948;

}  // namespace

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
