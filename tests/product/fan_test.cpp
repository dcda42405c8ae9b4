#include "simulate/product/fan.h"

#include "support/sonars.h"

namespace {

Sonar fan_sonar(double azimuth_deg, double range_min_m, int range_bins, int beams) {
    SonarConfig config;
    config.azimuth_deg = azimuth_deg;
    set_range(config, range_min_m, 10.0, range_bins);
    config.azimuth_bins = beams;
    return make_sonar(config, {});
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

/// The grey value of a pixel, without a table: the mean of the bins nearest to its centre, as many
/// as it covers.
int direct_grey(const Sonar& sonar, const FanMap& map, const Ping& ping, std::size_t index) {
    const View& view = sonar.settings.view;
    const int column = static_cast<int>(index) % map.frame.width;
    const int row = static_cast<int>(index) / map.frame.width;
    const FanPlace place = fan_place(map.frame, view.range_max_m, column, row);
    const double beams_per_pixel =
        map.frame.pixel_m * view.beams / view.azimuth_rad / place.range_m;
    // The extent grows in steps of an eighth from ring to ring.
    double extent = 1.0;
    while (extent < std::min({beams_per_pixel, 128.0, static_cast<double>(view.beams)}))
        extent *= 1.125;
    const auto beams = static_cast<int>(std::lround(extent));
    const auto bins = std::max(1, static_cast<int>(std::lround(map.frame.pixel_m / view.bin_m())));
    const double bin = (place.range_m - view.range_min_m) / view.bin_m() - 0.5;
    const double beam = ColumnFinder(sonar)(place.azimuth_rad) - 0.5;
    double mean = 0.0;
    for (int k = 0; k < bins * beams; ++k) {
        const int i = static_cast<int>(std::ceil(bin - 0.5 * bins)) + k / beams;
        int j = static_cast<int>(std::ceil(beam - 0.5 * beams)) + k % beams;
        if (map.full_turn) j = (j + 2 * ping.beams) % ping.beams;
        mean += ping.at(std::clamp(i, 0, ping.range_bins - 1), std::clamp(j, 0, ping.beams - 1));
    }
    return static_cast<int>(255.0 * std::sqrt(std::clamp(mean / bins / beams, 0.0, 1.0)) + 0.5);
}

}  // namespace

TEST_CASE("fan: the frame fits the sector") {
    struct Case {
        double azimuth_deg;
        int range_bins, asked, width, height;
    };
    // The chord is 2 x 10 m x sin(half the angle); 10 m cos(half of it) lie behind the sonar. A
    // sector is never higher than twice its width. By default a pixel is a range bin.
    for (const Case& one : {Case{60, 512, 1024, 1024, 1024},
                            {120, 512, 1000, 1000, 578},
                            {240, 512, 1000, 1000, 750},
                            {360, 512, 1000, 1000, 1000},
                            {2, 512, 100, 100, 200},
                            {60, 512, 0, 512, 512},
                            {2, 512, 0, 256, 512}}) {
        CAPTURE(one.azimuth_deg);
        const FanFrame frame =
            fan_frame(fan_sonar(one.azimuth_deg, 0, one.range_bins, 8), one.asked);
        CHECK(frame.width == one.width);
        CHECK(frame.height == one.height);
    }
    CHECK(fan_frame(fan_sonar(60, 0, 512, 8), 1024).pixel_m == approx(10.0 / 1024));
    CHECK(fan_frame(fan_sonar(120, 0, 4096, 8), 0).width == 1024);
}

TEST_CASE("fan: a bright bin lies where an operator expects it, port on the left") {
    for (const double azimuth_deg : {40.0, 120.0, 250.0, 360.0}) {
        const Sonar sonar = fan_sonar(azimuth_deg, 0.5, 100, 60);
        const FanMap map = make_fan_map(sonar, 700);
        for (const int range_bin : {5, 50, 99}) {
            for (const int beam : {0, 17, 30, 59}) {
                Ping ping = even_ping(sonar, 0.0F);
                ping.intensity[static_cast<std::size_t>(range_bin) * ping.beams + beam] = 1.0F;
                const std::vector<std::uint8_t> image = render_fan(map, ping, 1.0);
                const double r0 = sonar.range_edges_m[range_bin];
                const double r1 = sonar.range_edges_m[range_bin + 1];
                const double a0 = sonar.azimuth_edges_rad[beam];
                const double a1 = sonar.azimuth_edges_rad[beam + 1];
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
                const double pixel_m = map.frame.pixel_m;
                // Farther out are more pixels: by the bin's variance over the range.
                const double off_m = 0.25 * pixel_m + (r1 - r0) * (r1 - r0) / (3.0 * r0);
                const double off_rad = 0.5 * pixel_m / r0;
                CAPTURE_ALL(azimuth_deg, range_bin, beam);
                CHECK(std::fabs(range / sum - 0.5 * (r0 + r1)) < off_m);
                CHECK(std::fabs(beside / sum) < off_rad);
                const double pixels = 0.5 * (a1 - a0) * (r1 * r1 - r0 * r0) / (pixel_m * pixel_m);
                CHECK(sum == approx(pixels).epsilon(0.05 + 2.0 / pixels));
            }
        }
    }
}

TEST_CASE("fan: a uniform ping gives a uniform fan with smooth edges and a black surround") {
    // 255 sqrt(0.25) = 127.5, which rounds to 128. Bins larger and smaller than a pixel.
    for (const double azimuth_deg : {1.0, 60.0, 120.0, 180.0, 250.0, 359.0, 360.0}) {
        for (const int width : {97, 700}) {
            const Sonar sonar = fan_sonar(azimuth_deg, 0.7, 512, 300);
            const FanMap map = make_fan_map(sonar, width);
            const auto image = render_fan(map, even_ping(sonar, 0.25F), 1.0);
            REQUIRE(image.size() == static_cast<std::size_t>(map.frame.width) * map.frame.height);
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
            CAPTURE_ALL(azimuth_deg, width);
            CHECK(uneven == 0);
            CHECK(lit_outside == 0);
            const double sector_m2 = 0.5 * radians(azimuth_deg) * (10.0 * 10.0 - 0.7 * 0.7);
            const double sector_px = sector_m2 / (map.frame.pixel_m * map.frame.pixel_m);
            CHECK(area == approx(sector_px).epsilon(azimuth_deg > 1.0 ? 0.002 : 0.05));
        }
    }
}

TEST_CASE("fan: edges are anti-aliased") {
    const Sonar sonar = fan_sonar(120, 0, 64, 64);
    const FanMap map = make_fan_map(sonar, 400);
    const auto image = render_fan(map, even_ping(sonar, 1.0F), 1.0);
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

TEST_CASE("fan: a pixel is the bin at its centre, or the mean of those it covers" *
          doctest::skip(sanitized)) {
    // A table that is off by a bin changes most pixels of noise. Rounding changes those whose place
    // lies on a border, as on the diagonals of a full turn.
    std::mt19937 random(23);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 8) * 0x1p-24;
    };
    for (int scene = 0; scene < 24; ++scene) {
        const double azimuth_deg = scene % 6 == 0 ? 360.0 : uniform(5.0, 340.0);
        // In this order: compilers draw the arguments of a call in different orders.
        const double range_min_m = uniform(0.0, 3.0);
        const int range_bins = 20 + static_cast<int>(random() % 300);
        const int beams = 8 + static_cast<int>(random() % 200);
        const Sonar sonar = fan_sonar(azimuth_deg, range_min_m, range_bins, beams);
        const int width = scene % 3 == 0 ? 0 : 40 + static_cast<int>(random() % 400);
        const FanMap map = make_fan_map(sonar, width);
        Ping ping = even_ping(sonar, 0.0F);
        for (float& value : ping.intensity)
            value = static_cast<float>(uniform(0.0, 1.2));
        const std::vector<std::uint8_t> image = render_fan(map, ping, 1.0);
        std::size_t different = 0;
        for (std::size_t i = 0; i < image.size(); ++i) {
            if (depth(sonar, map.frame, i) < 1.5) continue;  // an edge is near
            const int expected = direct_grey(sonar, map, ping, i);
            different += std::abs(image[i] - expected) > 1;
        }
        CAPTURE(scene);
        CHECK(different <= 3 * static_cast<std::size_t>(map.frame.width));
    }
}

TEST_CASE("fan: full scale is white, more is white, nothing is black") {
    const Sonar sonar = fan_sonar(90, 0, 16, 16);
    const FanMap map = make_fan_map(sonar, 64);
    const std::size_t centre = static_cast<std::size_t>(map.frame.height / 2) * 64 + 32;
    const auto grey = [&](float intensity, double full_scale) {
        return render_fan(map, even_ping(sonar, intensity), full_scale)[centre];
    };
    CHECK(grey(0.0F, 1.0) == 0);
    CHECK(grey(1.0F, 1.0) == 255);
    CHECK(grey(7.0F, 1.0) == 255);
    CHECK(grey(2.5F, 10.0) == 128);
    CHECK(grey(0.01F, 1.0) == 26);  // 25.5 rounds up
    CHECK(grey(INFINITY, 1.0) == 255);
}
