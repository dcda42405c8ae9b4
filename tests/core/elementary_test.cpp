#include "core/elementary.h"

#include "support/test.h"

// The reference values come from the C library's functions in long double.

namespace {

long double apart(double value, long double truth) {
    return std::fabs(value - truth);
}

}  // namespace

TEST_CASE("elementary: sine and cosine are off by less than 1e-15") {
    long double worst = 0.0;
    const auto probe = [&](double x) {
        const SinCos result = sincos(x);
        worst = std::max({worst, apart(result.sin, std::sin((long double)x)),
                          apart(result.cos, std::cos((long double)x))});
    };
    // The accuracy is promised up to 1e5 rad; steps of 4.99 avoid multiples of pi.
    for (int i = -20000; i <= 20000; ++i) {
        probe(i * 0.001);
        probe(i * 4.99);
    }
    // Points where the reduction changes quadrant, and one step of double to either side.
    for (int k = -1000; k <= 1000; ++k) {
        const double x = k * (pi / 4.0);
        for (const double at : {x, std::nextafter(x, 1e9), std::nextafter(x, -1e9)})
            probe(at);
    }
    CHECK(worst < 1e-15);
    CHECK(sincos(0.0).sin == 0.0);
    CHECK(sincos(0.0).cos == 1.0);
}

TEST_CASE("elementary: arctan2 and arcsin are off by less than 1e-15") {
    long double worst = 0.0;
    for (int i = 0; i < 40000; ++i) {
        const double angle = i * (2.0 * pi / 40000.0);
        for (const double r : {1e-300, 1e-3, 1.0, 7.3, 1e300}) {
            const double y = r * std::sin(angle);
            const double x = r * std::cos(angle);
            worst =
                std::max(worst, apart(arctan2(y, x), std::atan2((long double)y, (long double)x)));
        }
    }
    for (int i = -10000; i <= 10000; ++i) {
        const double x = i / 10000.0;
        worst = std::max(worst, apart(arcsin(x), std::asin((long double)x)));
    }
    CHECK(worst < 1e-15);
}

TEST_CASE("elementary: arctan2 on the axes and at the origin") {
    CHECK(arctan2(0.0, 1.0) == 0.0);
    CHECK(arctan2(1.0, 0.0) == approx(pi / 2).epsilon(1e-15));
    CHECK(arctan2(-1.0, 0.0) == approx(-pi / 2).epsilon(1e-15));
    // The branch cut runs along the negative x axis: the sign of a zero selects its side.
    CHECK(arctan2(0.0, -1.0) == approx(pi).epsilon(1e-15));
    CHECK(arctan2(-0.0, -1.0) == approx(-pi).epsilon(1e-15));
    CHECK(std::signbit(arctan2(-0.0, 1.0)));
    CHECK_FALSE(std::signbit(arctan2(0.0, 1.0)));
    for (const double y : {0.0, -0.0}) {
        for (const double x : {0.0, -0.0})
            CHECK(arctan2(y, x) == 0.0);
    }
    // The test of bin edges relies on results within [-pi, pi].
    CHECK(arctan2(1e-300, -1.0) <= pi);
    CHECK(arctan2(-1e-300, -1.0) >= -pi);
}

TEST_CASE("elementary: e^x is off by less than 1e-15 of itself, and defined for every x") {
    long double worst = 0.0;
    for (int i = -70800; i <= 70970; ++i) {
        const double x = i * 0.01;
        const long double truth = std::exp((long double)x);
        worst = std::max(worst, apart(exponential(x), truth) / truth);
    }
    CHECK(worst < 1e-15);
    CHECK(exponential(0.0) == 1.0);
    // Subnormal results have the precision of subnormal numbers; below them the result is 0.
    CHECK(std::fabs(exponential(-740.0) - std::exp(-740.0)) <= 5e-324);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double x : {-746.0, -1e4, -1e300, -infinity})
        CHECK(exponential(x) == 0.0);
    for (const double x : {710.0, 1e4, infinity})
        CHECK(exponential(x) == infinity);
    CHECK(std::isnan(exponential(std::nan(""))));
}
