#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/units.h"

// Elementary functions with the same result on every processor. The C library's functions choose a
// variant by the processor, and the variants differ in the last bit. Functions for inner loops are
// branch-free, so that the loops vectorise. IEEE 754 fixes sqrt, floor and fma of <cmath>.

namespace sonarsim {

/// c0 + c1 x + c2 x^2 + ... by Horner's rule, rounded once per term. It calls fma() explicitly,
/// since the build forbids compilers to contract products and sums.
constexpr float polynomial(float, float c0) {
    return c0;
}
template <class... Rest>
inline float polynomial(float x, float c0, Rest... rest) {
    return std::fma(x, polynomial(x, rest...), c0);
}

template <class T>
struct SineCosine {
    T sin, cos;
};
using SinCos = SineCosine<double>;
using SinCosFloat = SineCosine<float>;

/// Sine and cosine, absolute error below 1e-15 for |x| up to 1e5 rad. Cody and Waite's reduction to
/// [-pi/4, pi/4] (pi/2 in two parts), then the Taylor series.
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
        case 0:
            return {sine, cosine};
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        default:
            return {-cosine, sine};
    }
}

/// sin(pi t) / (pi t).
inline double sinc(double t) {
    return std::fabs(t) < 1e-9 ? 1.0 : sincos(pi * t).sin / (pi * t);
}

/// The angle of the point (x, y), in [-pi, pi]; 0 at the origin. Absolute error below 1e-15.
/// The argument is halved twice, tan(a/2) = t / (1 + sqrt(1 + t^2)), before the Taylor series.
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
    for (int n = 25; n >= 1; n -= 2)
        series = 1.0 / n - series * t2;
    double angle = 4.0 * t * series;
    if (ay > ax) angle = 0.5 * pi - angle;
    if (std::signbit(x) && high > 0.0) angle = pi - angle;
    return std::signbit(y) ? -angle : angle;
}

/// arctan2 in float to 2e-6. The argument is halved once: the series meets |t| <= tan(pi/8).
inline float arctan2_float(float y, float x) {
    const float ax = std::fabs(x);
    const float ay = std::fabs(y);
    const float high = ax > ay ? ax : ay;
    const float low = ax > ay ? ay : ax;
    const float below = high + std::sqrt(high * high + low * low);
    const float t = below > 0.0F ? low / below : 0.0F;
    const float t2 = t * t;
    const float series =
        polynomial(t2, 1.0F, -1.0F / 3, 1.0F / 5, -1.0F / 7, 1.0F / 9, -1.0F / 11, 1.0F / 13);
    float angle = 2.0F * t * series;
    if (ay > ax) angle = static_cast<float>(0.5 * pi) - angle;
    if (std::signbit(x) && high > 0.0F) angle = static_cast<float>(pi) - angle;
    return std::signbit(y) ? -angle : angle;
}

inline double arcsin(double x) {
    return arctan2(x, std::sqrt((1.0 - x) * (1.0 + x)));
}

/// e^x for every x, relative error below 1e-15 where the result is a normal number; 0 below the
/// smallest number, infinity above the largest, NaN for NaN. Cody and Waite's reduction to e^x =
/// 2^k e^y with |y| <= ln(2) / 2 (ln 2 in two parts), then the Taylor series.
inline double exponential(double x) {
    constexpr double ln2_high = 0x1.62e42fefa39efp-1;
    constexpr double ln2_low = 0x1.abc9e3b39803fp-56;
    if (std::isnan(x)) return x;
    if (x < -746.0) return 0.0;
    if (x > 710.0) return std::numeric_limits<double>::infinity();
    const double k = std::floor(x / ln2_high + 0.5);
    const double y = std::fma(-k, ln2_low, std::fma(-k, ln2_high, x));
    double series = 1.0;
    for (int n = 14; n >= 1; --n)
        series = 1.0 + series * y / n;
    // Two factors: 2^k may overflow or underflow although the result does not.
    const auto power_of_two = [](std::int64_t exponent) {
        return std::bit_cast<double>((exponent + 1023) << 52);
    };
    const auto whole = static_cast<std::int64_t>(k);
    return series * power_of_two(whole / 2) * power_of_two(whole - whole / 2);
}

/// Natural logarithm of a positive, normal float; relative error below 3e-7 away from 1, absolute
/// below 1e-7 near it. x = 2^e m with m in [sqrt(1/2), sqrt(2)); ln m = 2 artanh((m - 1)/(m + 1)).
inline float natural_log(float x) {
    const auto bits = std::bit_cast<std::int32_t>(x);
    const std::int32_t exponent = (bits - 0x3f3504f3) >> 23;
    const float m = std::bit_cast<float>(bits - exponent * (1 << 23));
    const float s = (m - 1.0F) / (m + 1.0F);
    const float s2 = s * s;
    const float series = polynomial(s2, 1.0F, 1.0F / 3, 1.0F / 5, 1.0F / 7, 1.0F / 9);
    return std::fma(2.0F * s, series, static_cast<float>(exponent) * 0.69314718056F);
}

/// Natural logarithm of a positive, normal double; relative error below 1e-14 away from 1, absolute
/// below 1e-15 near it. x = 2^e m with m in [sqrt(1/2), sqrt(2)); ln m = 2 artanh((m - 1)/(m + 1)).
inline double logarithm(double x) {
    constexpr double ln2 = 0x1.62e42fefa39efp-1;
    const auto bits = std::bit_cast<std::int64_t>(x);
    const std::int64_t exponent = (bits - 0x3fe6a09e667f3bcd) >> 52;
    const double m = std::bit_cast<double>(bits - exponent * (std::int64_t{1} << 52));
    const double s = (m - 1.0) / (m + 1.0);
    const double s2 = s * s;
    double series = 0.0;
    for (int n = 23; n >= 1; n -= 2)
        series = 1.0 / n + series * s2;
    return std::fma(2.0 * s, series, static_cast<double>(exponent) * ln2);
}

/// x^y for positive x.
inline double power(double x, double y) {
    return exponential(y * logarithm(x));
}

/// Sine and cosine of an angle within [-pi, pi] to 1e-6: Taylor series of the half angle.
inline SinCosFloat sincos_small(float x) {
    const float y = 0.5F * x;
    const float t = y * y;
    const float s = y * polynomial(t, 1.0F, -1.0F / 6, 1.0F / 120, -1.0F / 5040, 1.0F / 362880,
                                   -1.0F / 39916800);
    const float c = polynomial(t, 1.0F, -1.0F / 2, 1.0F / 24, -1.0F / 720, 1.0F / 40320,
                               -1.0F / 3628800, 1.0F / 479001600);
    return {2.0F * s * c, 1.0F - 2.0F * s * s};
}

/// Sine and cosine of an angle in whole turns that a float holds with a fraction; to 1e-6.
inline SinCosFloat sincos_turns(float turns) {
    return sincos_small(static_cast<float>(2.0 * pi) * (turns - std::floor(turns + 0.5F)));
}

/// ln Gamma(a) of a > 0, by Stirling's series at a + 10.
inline double log_gamma(double a) {
    double product = 1.0;
    for (int n = 0; n < 10; ++n)
        product *= a + n;
    const double b = a + 10.0;
    const double series =
        1.0 / (12.0 * b) - 1.0 / (360.0 * b * b * b) + 1.0 / (1260.0 * b * b * b * b * b);
    return (b - 0.5) * logarithm(b) - b + 0.5 * logarithm(2.0 * pi) + series - logarithm(product);
}

}  // namespace sonarsim
