#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/units.h"

// Elementary functions of our own. The C library's choose a variant by the processor that they
// run on, and the variants differ in the last bit; a dataset must not. These are branch-free where
// it matters, so that a loop over them vectorises. Only sqrt, floor and fma of <cmath> are used:
// IEEE 754 fixes their results.

namespace sonarsim {

struct SinCos {
    double sin;
    double cos;
};

/// Sine and cosine, absolute error below 1e-15 for |x| up to 1e5 rad. Reduction to [-pi/4, pi/4]
/// by a pi/2 in two parts (Cody and Waite), then the Taylor series.
inline SinCos sincos(double x) {
    constexpr double half_pi_high = 0x1.921fb54442d18p+0;
    constexpr double half_pi_low = 0x1.1a62633145c07p-54;
    const double quarter = std::floor(x / half_pi_high + 0.5);
    const double y = std::fma(-quarter, half_pi_low, std::fma(-quarter, half_pi_high, x));
    const double y2 = y * y;
    double sine = 0.0;
    double cosine = 0.0;
    for (int n = 16; n >= 0; n -= 2) {
        sine = 1.0 - sine * y2 / ((n + 2.0) * (n + 3.0));
        cosine = 1.0 - cosine * y2 / ((n + 1.0) * (n + 2.0));
    }
    sine *= y;
    switch (static_cast<std::int64_t>(quarter) & 3) {
        case 0: return {sine, cosine};
        case 1: return {cosine, -sine};
        case 2: return {-sine, -cosine};
        default: return {-cosine, sine};
    }
}

/// The angle of the point (x, y), in [-pi, pi]; 0 at the origin. Absolute error below 1e-15.
/// The argument is halved twice, tan(a/2) = t / (1 + sqrt(1 + t^2)), so that the Taylor series of
/// the arctangent meets |t| <= tan(pi/16).
inline double arctan2(double y, double x) {
    const double ax = std::fabs(x);
    const double ay = std::fabs(y);
    const double high = ax > ay ? ax : ay;
    const double low = ax > ay ? ay : ax;
    double t = high > 0.0 ? low / high : 0.0;
    t /= 1.0 + std::sqrt(1.0 + t * t);
    t /= 1.0 + std::sqrt(1.0 + t * t);
    const double t2 = t * t;
    double series = 0.0;
    for (int n = 25; n >= 1; n -= 2) series = 1.0 / n - series * t2;
    double angle = 4.0 * t * series;
    if (ay > ax) angle = 0.5 * pi - angle;
    if (std::signbit(x) && high > 0.0) angle = pi - angle;
    return std::signbit(y) ? -angle : angle;
}

inline double arcsin(double x) { return arctan2(x, std::sqrt((1.0 - x) * (1.0 + x))); }
inline double arccos(double x) { return arctan2(std::sqrt((1.0 - x) * (1.0 + x)), x); }

}  // namespace sonarsim
