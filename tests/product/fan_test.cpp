#include "product/fan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/units.h"
#include "sonar/sonar.h"
#include "support/approx.h"

using namespace sonarsim;

namespace {

Sonar fan_sonar(double azimuth_deg, double range_min_m, int range_bins, int beams) {
    SonarConfig config;
    config.name = "test";
    config.azimuth_deg = azimuth_deg;
    config.range_min_m = range_min_m;
    config.range_max_m = 10.0;
    config.range_bins = range_bins;
    config.azimuth_bins = beams;
    return make_sonar(config, {});
}

Ping uniform_ping(const Sonar& sonar, float intensity) {
    Ping ping;
    ping.range_bins = sonar.config.range_bins;
    ping.beams = sonar.config.azimuth_bins;
    ping.intensity.assign(static_cast<std::size_t>(ping.range_bins) * ping.beams, intensity);
    return ping;
}

/// Grey back to a share of full scale.
double share(std::uint8_t grey) {
    return grey / 255.0 * (grey / 255.0);
}

/// The polar coordinates of a pixel's centre; the image's left is port, azimuth > 0.
struct Polar {
    double range_m;
    double azimuth_rad;
};
Polar polar(const FanFrame& frame, std::size_t index) {
    const double column = static_cast<double>(index % frame.width) + 0.5;
    const double row = static_cast<double>(index / frame.width) + 0.5;
    const double ahead = 10.0 - row * frame.pixel_m;
    const double left = (0.5 * frame.width - column) * frame.pixel_m;
    return {std::hypot(ahead, left), std::atan2(left, ahead)};
}

/// The distance of a pixel's centre from the edge of the sector, px; positive inside.
double depth(const Sonar& sonar, const FanFrame& frame, std::size_t index) {
    const Polar p = polar(frame, index);
    const double aside = 0.5 * radians(sonar.config.azimuth_deg) - std::fabs(p.azimuth_rad);
    // The distance from the edge's line while its foot lies on the edge, else from the apex.
    const double beside =
        std::fabs(aside) < 0.5 * pi ? p.range_m * std::sin(aside) : std::copysign(p.range_m, aside);
    const double radial =
        std::min(p.range_m - sonar.config.range_min_m, sonar.config.range_max_m - p.range_m);
    const double edge = sonar.config.azimuth_deg < 360.0 ? std::min(radial, beside) : radial;
    return edge / frame.pixel_m;
}

}  // namespace

TEST_SUITE("product") {
    TEST_CASE("fan: the frame fits the sector") {
        // 60 degrees: the chord is 2 * 10 m * sin 30 = 10 m, as wide as the sector is high.
        const FanFrame narrow = fan_frame(fan_sonar(60, 0, 512, 256), 1024);
        CHECK(narrow.width == 1024);
        CHECK(narrow.height == 1024);
        CHECK(narrow.pixel_m == test::approx(10.0 / 1024));
        // 120 degrees: 2 * 10 m * sin 60 = 17.32 m wide, 10 m high; 1000 / 1.732 = 577.4.
        const FanFrame usual = fan_frame(fan_sonar(120, 0, 512, 256), 1000);
        CHECK(usual.height == 578);
        // 240 degrees: 20 m wide; 10 m ahead and 10 m * cos 60 = 5 m behind.
        const FanFrame wide = fan_frame(fan_sonar(240, 0, 512, 256), 1000);
        CHECK(wide.height == 750);
        const FanFrame circle = fan_frame(fan_sonar(360, 0, 512, 256), 1000);
        CHECK(circle.height == 1000);
        // Two degrees: never higher than twice the width, however slim the sector.
        const FanFrame slim = fan_frame(fan_sonar(2, 0, 512, 8), 100);
        CHECK(slim.width == 100);
        CHECK(slim.height == 200);
    }

    TEST_CASE("fan: by default a pixel is a range bin, and no image is wider than 1024") {
        const FanFrame tank = fan_frame(fan_sonar(60, 0, 512, 256), 0);
        CHECK(tank.width == 512);
        CHECK(tank.height == 512);
        const FanFrame slim = fan_frame(fan_sonar(2, 0, 512, 8), 0);
        CHECK(slim.width == 256);
        CHECK(slim.height == 512);
        CHECK(fan_frame(fan_sonar(120, 0, 4096, 8), 0).width == 1024);
    }

    TEST_CASE("fan: a bright bin lies where an operator expects it, port on the left") {
        for (const double azimuth_deg : {40.0, 120.0, 250.0, 360.0}) {
            const Sonar sonar = fan_sonar(azimuth_deg, 0.5, 100, 60);
            const FanMap map = make_fan_map(sonar, 700);
            for (const int range_bin : {5, 50, 99}) {
                for (const int beam : {0, 17, 30, 59}) {
                    Ping ping = uniform_ping(sonar, 0.0F);
                    ping.intensity[static_cast<std::size_t>(range_bin) * ping.beams + beam] = 1.0F;
                    const std::vector<std::uint8_t> image = render_fan(map, ping, 1.0);
                    const double r0 = sonar.range_edges_m[range_bin];
                    const double r1 = sonar.range_edges_m[range_bin + 1];
                    const double a0 = sonar.azimuth_edges_rad[beam];
                    const double a1 = sonar.azimuth_edges_rad[beam + 1];
                    // The centroid of the echo as the picture shows it, from the middle of the bin.
                    const double azimuth = 0.5 * (a0 + a1);
                    double beside = 0.0;
                    double range = 0.0;
                    double sum = 0.0;
                    for (std::size_t i = 0; i < image.size(); ++i) {
                        const double weight = share(image[i]);
                        const Polar p = polar(map.frame, i);
                        beside += weight * std::remainder(p.azimuth_rad - azimuth, 2.0 * pi);
                        range += weight * p.range_m;
                        sum += weight;
                    }
                    REQUIRE(sum > 0.0);
                    // At an edge what would lie beyond it lies before it, a seventh of a bin off.
                    const bool last_beam = azimuth_deg < 360.0 && (beam == 0 || beam == 59);
                    const double pixel_m = map.frame.pixel_m;
                    // Farther out are more pixels: by the kernel's variance over the range.
                    const double off_m = 0.25 * pixel_m + (r1 - r0) * (r1 - r0) / (3.0 * r0) +
                                         (range_bin == 99 ? (r1 - r0) / 7 : 0.0);
                    const double off_rad = 0.25 * pixel_m / r0 + (last_beam ? (a1 - a0) / 7 : 0.0);
                    CAPTURE(azimuth_deg);
                    CAPTURE(range_bin);
                    CAPTURE(beam);
                    CHECK(std::fabs(range / sum - 0.5 * (r0 + r1)) < off_m);
                    CHECK(std::fabs(beside / sum) < off_rad);
                    const double pixels =
                        0.5 * (a1 - a0) * (r1 * r1 - r0 * r0) / (pixel_m * pixel_m);
                    CHECK(sum == test::approx(pixels).epsilon(0.05 + 0.5 / pixels));
                }
            }
        }
        // Said once without formulas: the last beam is port, and port is on the left.
        const Sonar sonar = fan_sonar(120, 0, 10, 2);
        Ping ping = uniform_ping(sonar, 0.0F);
        for (int i = 0; i < ping.range_bins; ++i)
            ping.intensity[2 * i + 1] = 1.0F;
        const FanMap map = make_fan_map(sonar, 100);
        const std::vector<std::uint8_t> image = render_fan(map, ping, 1.0);
        const std::size_t middle = static_cast<std::size_t>(map.frame.height / 2) * 100;
        CHECK(image[middle + 10] > 250);
        CHECK(image[middle + 90] < 30);
    }

    TEST_CASE("fan: a uniform ping gives a uniform fan with smooth edges and a black surround") {
        // 255 sqrt(0.25) = 127.5, which rounds to 128. Bins larger and smaller than a pixel.
        for (const double azimuth_deg : {1.0, 60.0, 120.0, 180.0, 250.0, 359.0, 360.0}) {
            for (const int width : {97, 700}) {
                const Sonar sonar = fan_sonar(azimuth_deg, 0.7, 512, 300);
                const FanMap map = make_fan_map(sonar, width);
                const auto image = render_fan(map, uniform_ping(sonar, 0.25F), 1.0);
                REQUIRE(image.size() ==
                        static_cast<std::size_t>(map.frame.width) * map.frame.height);
                std::size_t uneven = 0;
                std::size_t lit_outside = 0;
                double area = 0.0;
                for (std::size_t i = 0; i < image.size(); ++i) {
                    // Half a pixel's diagonal is 0.71 px.
                    const double inside = depth(sonar, map.frame, i);
                    if (inside > 0.72 && image[i] != 128) ++uneven;
                    if (inside < -0.72 && image[i] != 0) ++lit_outside;
                    area += share(image[i]) / share(128);
                }
                CAPTURE(azimuth_deg);
                CAPTURE(width);
                CHECK(uneven == 0);
                CHECK(lit_outside == 0);
                const double sector_m2 = 0.5 * radians(azimuth_deg) * (10.0 * 10.0 - 0.7 * 0.7);
                const double sector_px = sector_m2 / (map.frame.pixel_m * map.frame.pixel_m);
                CHECK(area == test::approx(sector_px).epsilon(azimuth_deg > 1.0 ? 0.002 : 0.05));
            }
        }
    }

    TEST_CASE("fan: edges are anti-aliased") {
        const Sonar sonar = fan_sonar(120, 0, 64, 64);
        const FanMap map = make_fan_map(sonar, 400);
        const auto image = render_fan(map, uniform_ping(sonar, 1.0F), 1.0);
        // Along the arc, coverage is the depth of the pixel's centre plus a half, to within the
        // 16 points' 1/16 and what the slope adds.
        double worst = 0.0;
        int partial = 0;
        for (std::size_t i = 0; i < image.size(); ++i) {
            const double inside = depth(sonar, map.frame, i);
            if (std::fabs(inside) > 2.0 || polar(map.frame, i).range_m < 9.0) continue;
            if (std::fabs(polar(map.frame, i).azimuth_rad) > radians(55)) continue;
            const double expected = std::clamp(inside + 0.5, 0.0, 1.0);
            worst = std::max(worst, std::fabs(share(image[i]) - expected));
            if (image[i] > 0 && image[i] < 255) ++partial;
        }
        CHECK(worst < 0.2);
        CHECK(partial > 300);
    }

    TEST_CASE("fan: energy is kept") {
        // sum over pixels = sum over bins of intensity times area, both in pixels. 16 points per
        // pixel of independent bins: the statistical error is far below 0.5 %.
        std::mt19937 random(7);
        for (const int width : {200, 900}) {
            const Sonar sonar = fan_sonar(120, 0.1, 256, 256);
            Ping ping = uniform_ping(sonar, 0.0F);
            for (float& value : ping.intensity)
                value = static_cast<float>(random() >> 8) * 0x1p-24F;
            const FanMap map = make_fan_map(sonar, width);
            double expected = 0.0;
            for (int i = 0; i < ping.range_bins; ++i) {
                const double r0 = sonar.range_edges_m[i];
                const double r1 = sonar.range_edges_m[i + 1];
                const double area = 0.5 * radians(120) / ping.beams * (r1 * r1 - r0 * r0);
                for (int j = 0; j < ping.beams; ++j)
                    expected += ping.at(i, j) * area;
            }
            expected /= map.frame.pixel_m * map.frame.pixel_m;
            double sum = 0.0;
            for (const std::uint8_t grey : render_fan(map, ping, 1.0))
                sum += share(grey);
            CHECK(sum == test::approx(expected).epsilon(0.005));
        }
    }

    TEST_CASE("fan: white noise is as strong in a pixel as in the next") {
        // Over 1000 pings of independent bins, the standard deviation of a pixel is known to
        // 1 / sqrt(2000) = 2.2 %, the ratio of two to 3.2 %; of 20,000 ratios the largest is about
        // 4.3 of those off, 14 %. Shares of area, without a kernel, give up to 2.5.
        constexpr int pings = 1000;
        std::mt19937 random(11);
        for (const int width : {0, 70, 130}) {  // a pixel per range bin; larger; smaller
            const Sonar sonar = fan_sonar(60, 0.5, 96, 48);
            const FanMap map = make_fan_map(sonar, width);
            const std::size_t pixels = static_cast<std::size_t>(map.frame.width) * map.frame.height;
            std::vector<double> sum(pixels);
            std::vector<double> squares(pixels);
            Ping ping = uniform_ping(sonar, 0.0F);
            for (int k = 0; k < pings; ++k) {
                for (float& value : ping.intensity)
                    value = (random() & 1U) != 0 ? 0.75F : 0.25F;
                const std::vector<std::uint8_t> image = render_fan(map, ping, 1.0);
                for (std::size_t i = 0; i < pixels; ++i) {
                    sum[i] += share(image[i]);
                    squares[i] += share(image[i]) * share(image[i]);
                }
            }
            const auto spread = [&](std::size_t i) {
                return std::sqrt(squares[i] / pings - sum[i] / pings * (sum[i] / pings));
            };
            double worst = 1.0;
            for (std::size_t i = 0; i + map.frame.width < pixels; ++i) {
                for (const std::size_t next : {i + 1, i + map.frame.width}) {
                    if (depth(sonar, map.frame, i) < 1.0 || depth(sonar, map.frame, next) < 1.0)
                        continue;
                    const double ratio = spread(i) / spread(next);
                    worst = std::max({worst, ratio, 1.0 / ratio});
                }
            }
            CAPTURE(width);
            CHECK(worst < 1.3);
        }
    }

    TEST_CASE("fan: bins much smaller than a pixel are averaged, not picked") {
        // Every other beam is occupied; 20 to 60 px from the apex, 3 to 10 beams share a pixel.
        // Picking would give black and white, averaging gives half.
        const Sonar sonar = fan_sonar(120, 0, 512, 512);
        Ping ping = uniform_ping(sonar, 0.0F);
        for (std::size_t i = 0; i < ping.intensity.size(); i += 2)
            ping.intensity[i] = 1.0F;
        const FanMap map = make_fan_map(sonar, 900);
        const auto image = render_fan(map, ping, 1.0);
        for (std::size_t i = 0; i < image.size(); ++i) {
            const double range_px = polar(map.frame, i).range_m / map.frame.pixel_m;
            if (range_px < 20.0 || range_px > 60.0 || depth(sonar, map.frame, i) < 1.0) continue;
            REQUIRE(std::fabs(share(image[i]) - 0.5) < 0.2);
        }
    }

    TEST_CASE("fan: full scale is white, more is white, nothing is black") {
        const Sonar sonar = fan_sonar(90, 0, 16, 16);
        const FanMap map = make_fan_map(sonar, 64);
        const std::size_t centre = static_cast<std::size_t>(map.frame.height / 2) * 64 + 32;
        const auto grey = [&](float intensity, double full_scale) {
            return render_fan(map, uniform_ping(sonar, intensity), full_scale)[centre];
        };
        CHECK(grey(0.0F, 1.0) == 0);
        CHECK(grey(1.0F, 1.0) == 255);
        CHECK(grey(7.0F, 1.0) == 255);
        CHECK(grey(2.5F, 10.0) == 128);
        CHECK(grey(0.01F, 1.0) == 26);  // 25.5 rounds up
        CHECK(grey(INFINITY, 1.0) == 255);
    }
}
