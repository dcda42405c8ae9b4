#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "compare/drawn_recording.h"
#include "compare/figures/amplitude.h"
#include "compare/figures/correlation.h"
#include "compare/figures/distances.h"
#include "compare/figures/patches.h"
#include "compare/figures/points.h"
#include "compare/figures/shadows.h"
#include "compare/figures/texture.h"
#include "compare/figures/zones.h"
#include "support/approx.h"

using namespace sonarsim;

namespace {

/// Amplitudes sqrt(-ln u)^(2/shape) of a Weibull distribution.
std::vector<float> weibull_draws(double shape, std::uint32_t count) {
    std::vector<float> out;
    for (std::uint32_t k = 0; k < count; ++k) {
        const PhiloxBlock draw =
            philox({k, 0, 0, 0}, {0x77656962U, static_cast<std::uint32_t>(8 * shape)});
        out.push_back(static_cast<float>(power(-natural_log(unit_float(draw.x0)), 1.0 / shape)));
    }
    return out;
}

}  // namespace

TEST_SUITE("compare") {
    TEST_CASE("figures: the shape of Weibull draws") {
        // The estimate varies by 0.78 shape / sqrt(n): four of these for 20,000 draws are 0.022.
        for (const double shape : {0.8, 1.5, 2.0, 4.0})
            CHECK(std::fabs(weibull_shape(weibull_draws(shape, 20000)) / shape - 1.0) < 0.022);
        CHECK(std::isnan(weibull_shape(std::vector<float>{0.0F, 1.0F})));
        CHECK(std::isnan(weibull_shape(std::vector<float>(9, 2.0F))));
    }

    TEST_CASE("figures: Rayleigh amplitudes have the figures of the formulas") {
        const std::vector<float> a = weibull_draws(2.0, 40000);
        // sqrt(4/pi - 1), 2 sqrt(pi) (pi - 3) / (4 - pi)^1.5, 1, and 10/ln 10 pi/sqrt(6) dB.
        const AmplitudeMoments moments = amplitude_moments(a);
        CHECK(std::fabs(moments.variation - 0.52272) < 0.01);
        CHECK(std::fabs(moments.skewness - 0.63111) < 0.06);
        CHECK(std::fabs(scintillation(a) - 1.0) < 0.06);
        CHECK(std::fabs(spread_db(a) - 5.5701) < 0.12);
        CHECK(std::fabs(inverse_k_shape(a)) < 0.03);
    }

    TEST_CASE("figures: a patch loses its trend and keeps its amplitudes") {
        // Powers of a plane: nothing but the trend.
        std::vector<float> power;
        for (int i = 0; i < 8; ++i) {
            for (int j = 0; j < 10; ++j)
                power.push_back(static_cast<float>(10 + i + 0.5 * j));
        }
        const Detrender detrender({8, 10});
        const PatchGrid grid({8, 10}, 8, 10);
        const auto plane = detrender.patch_of({power, 8, 10}, grid, 0);
        REQUIRE(plane.has_value());
        for (const float a : plane->amplitude)
            CHECK(a == test::approx(1.0F).epsilon(1e-5));
        CHECK(plane->mean_power == test::approx(10 + 3.5 + 2.25));
        std::vector<float> edge(80, 0.0F);
        std::fill(edge.begin() + 40, edge.end(), 1.0F);
        CHECK_FALSE(detrender.patch_of({edge, 8, 10}, grid, 0).has_value());
        CHECK_FALSE(detrender.patch_of({std::vector<float>(80), 8, 10}, grid, 0).has_value());
    }

    TEST_CASE("figures: correlations of a checkerboard") {
        std::vector<float> a;
        for (int i = 0; i < 8; ++i) {
            for (int j = 0; j < 6; ++j)
                a.push_back((i + j) % 2 == 0 ? 1.0F : 3.0F);
        }
        CHECK(range_correlation(a, {8, 6}, 1) == test::approx(-1.0));
        CHECK(range_correlation(a, {8, 6}, 2) == test::approx(1.0));
        CHECK(beam_correlation(a, {8, 6}, 3) == test::approx(-1.0));
        CHECK(std::isnan(beam_correlation(a, {8, 6}, 6)));
        CHECK(ping_correlation(a, a) == test::approx(1.0));
    }

    TEST_CASE("figures: zones of a bottom between weak ranges") {
        std::vector<double> powers(440, 1e-5);
        for (std::size_t i = 0; i < 10; ++i)
            powers[i] = 1.0;  // ringing
        for (std::size_t i = 200; i < 300; ++i)
            powers[i] = 1e-1;
        for (std::size_t i = 300; i < 440; ++i)
            powers[i] = 1e-3;
        const Zones zones = zones_of(powers);
        // Smoothing over 10 ranges moves an edge by at most 5.
        CHECK(std::abs(zones.bottom.from - 200) <= 5);
        CHECK(std::abs(zones.bottom.to - 300) <= 5);
        CHECK(std::abs(zones.water.to - 200) <= 10);
        CHECK(std::abs(zones.tail.from - 300) <= 10);
        CHECK(zones.tail.to == 440);
        const Zones flat = zones_of(std::vector<double>(100, 0.5));
        CHECK(flat.bottom.from == 0);
        CHECK(flat.bottom.to == 100);
        CHECK(flat.water.to == flat.water.from);
    }

    TEST_CASE("figures: the widths of a point echo") {
        // Powers of a Gaussian: exp(-x^2 / (2 s^2)) is half at x = 1.1774 s, a width of 2.3548 s;
        // linear interpolation between bins errs by less than 4 % at these widths.
        std::vector<float> power(60 * 64, 1e-6F);
        for (int i = 0; i < 60; ++i) {
            for (int j = 0; j < 64; ++j) {
                const double y = (i - 30) / 1.2;
                const double x = (j - 32) / 2.0;
                power[static_cast<std::size_t>(64 * i + j)] +=
                    static_cast<float>(exponential(-0.5 * (x * x + y * y)));
            }
        }
        const std::vector<PointEcho> points = point_echoes({power, 60, 64}, 5, 55);
        REQUIRE(points.size() == 1);
        CHECK(points[0].range == 30);
        CHECK(points[0].beam == 32);
        CHECK(points[0].width_beams == test::approx(4.71).epsilon(0.04));
        CHECK(points[0].width_ranges == test::approx(2.826).epsilon(0.04));
        CHECK(point_echoes({power, 60, 64}, 31, 55).empty());
    }

    TEST_CASE("figures: depth and far edge of shadows in speckle") {
        // Background of power 1; a shadow 20 dB deep over 30 ranges that rises linearly over 12:
        // from a quarter to three quarters are 6 ranges. Exponential draws, 16 columns of shadow.
        constexpr int ranges = 200, columns = 64;
        std::vector<float> power(ranges * columns);
        for (std::uint32_t i = 0; i < ranges; ++i) {
            for (std::uint32_t j = 0; j < columns; ++j) {
                double mean = 1.0;
                const double behind = static_cast<double>(i) - 110.0;
                if (i >= 80 && j >= 20 && j < 36)
                    mean = std::clamp(0.01 + 0.99 * behind / 12.0, 0.01, 1.0);
                const PhiloxBlock draw = philox({i, j, 0, 0}, {0x73686164U, 0});
                power[i * columns + j] =
                    static_cast<float>(-mean * natural_log(unit_float(draw.x0)));
            }
        }
        const std::vector<Shadow> shadows = shadows_of({power, ranges, columns}, {10, 190});
        // Its inner columns have it; the outer ones are smoothed with the background.
        CHECK(shadows.size() >= 12);
        CHECK(shadows.size() <= 18);
        std::vector<double> depths, edges;
        for (const Shadow& shadow : shadows) {
            if (shadow.column < 22 || shadow.column >= 34) continue;
            CHECK(std::abs(shadow.from - 81) <= 4);
            depths.push_back(shadow.depth_db);
            edges.push_back(shadow.edge_ranges);
        }
        // A median over 12 columns. 5 looks reach three quarters a little early or late.
        std::sort(depths.begin(), depths.end());
        std::sort(edges.begin(), edges.end());
        CHECK(std::fabs(depths[depths.size() / 2] + 20.0) < 1.5);
        CHECK(std::fabs(edges[edges.size() / 2] - 6.0) < 3.0);
        const std::vector<float> flat(ranges * columns, 1.0F);
        CHECK(shadows_of({flat, ranges, columns}, {10, 190}).empty());
    }

    TEST_CASE("figures: texture and distances") {
        const std::vector<float> flat(100, 1.0F);
        const auto same = texture_histogram({flat, 10, 10}, {{10, 10}, 10, 10}, 0);
        double sum = 0.0;
        for (const double count : same)
            sum += count;
        CHECK(sum == 64.0);
        CHECK(same[texture_patterns - 2] ==
              64.0);  // all neighbours reach the pixel: the last of 58
        const std::vector<double> one{1, 0, 0, 3};
        const std::vector<double> moved{0, 1, 0, 3};
        CHECK(jensen_shannon(one, one) == 0.0);
        CHECK(jensen_shannon(std::vector<double>{1, 0}, std::vector<double>{0, 5}) ==
              test::approx(1.0));
        CHECK(earth_movers(one, moved) == test::approx(0.25));
        CHECK(kullback_leibler(one, one) == 0.0);
        CHECK(kullback_leibler(one, moved) > 0.0);
    }
}
