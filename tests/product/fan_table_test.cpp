#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "core/units.h"
#include "product/fan.h"
#include "sonar/sonar.h"
#include "support/sanitized.h"

using namespace sonarsim;

namespace {

Sonar sonar_of(double azimuth_deg, double range_min_m, int range_bins, int beams) {
    SonarConfig config;
    config.name = "test";
    config.azimuth_deg = azimuth_deg;
    config.range_min_m = range_min_m;
    config.range_max_m = 10.0;
    config.range_bins = range_bins;
    config.azimuth_bins = beams;
    return make_sonar(config, {});
}

/// True if all points within 1.5 pixels of a pixel's centre lie in the sector.
bool is_far_inside(const Sonar& sonar, const FanFrame& frame, std::size_t index) {
    const View& view = sonar.settings.view;
    const double column = static_cast<double>(index % frame.width);
    const double row = static_cast<double>(index / frame.width);
    for (int k = 0; k < 16; ++k) {
        const double angle = 2.0 * pi * k / 16.0;
        if (!is_inside_sector(view,
                              fan_place(frame, view.range_max_m, column + 1.5 * std::cos(angle),
                                        row + 1.5 * std::sin(angle))))
            return false;
    }
    return true;
}

/// The grey value of a pixel, without a table: kernels in range and in azimuth at its centre.
int direct_grey(const Sonar& sonar, const FanMap& map, const Ping& ping, std::size_t index) {
    const View& view = sonar.settings.view;
    const int column = static_cast<int>(index) % map.frame.width;
    const int row = static_cast<int>(index) / map.frame.width;
    const FanPlace place = fan_place(map.frame, view.range_max_m, column, row);
    const double beams_per_pixel =
        map.frame.pixel_m * view.beams / view.azimuth_rad / place.range_m;
    // The extent of a kernel grows in steps of an eighth from ring to ring.
    double extent = 1.0;
    while (extent < std::min({beams_per_pixel, 128.0, static_cast<double>(view.beams)}))
        extent *= 1.125;
    const KernelTable across = make_kernel(extent, 4);
    const KernelTable along = make_kernel(std::min(map.frame.pixel_m / view.bin_m(), 128.0), 1);
    const KernelPlace bin = kernel_place((place.range_m - view.range_min_m) / view.bin_m());
    const KernelPlace beam = kernel_place(ColumnFinder(sonar)(place.azimuth_rad));
    double mean = 0.0;
    for (int k = 0; k < along.taps; ++k) {
        for (int b = 0; b < across.taps; ++b) {
            const int i = std::clamp(bin.bin + along.first[bin.phase] + k, 0, ping.range_bins - 1);
            int j = beam.bin + across.first[beam.phase] + b;
            const int turns = ping.beams * (1 + across.taps / ping.beams);
            j = map.full_turn ? (j + turns) % ping.beams : std::clamp(j, 0, ping.beams - 1);
            mean += static_cast<double>(along.weights[bin.phase * along.taps + k]) *
                    across.weights[beam.phase * across.taps + b] * ping.at(i, j);
        }
    }
    return static_cast<int>(255.0 * std::sqrt(std::clamp(mean, 0.0, 1.0)) + 0.5);
}

}  // namespace

TEST_SUITE("product") {
    TEST_CASE("fan: the table gives what direct resampling gives, on random sonars" *
              doctest::skip(test::sanitized)) {
        // Directly: every pixel, in doubles, is the mean of the bins around it by the kernels of
        // its place. A table that is off by a bin or a phase changes most pixels of noise; rounding
        // to floats changes a grey value by 1 where the value lies next to a border, and by more
        // where the place of a pixel lies next to the border of two phases of a kernel, as along
        // the axes of a full turn.
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
            const Sonar sonar = sonar_of(azimuth_deg, range_min_m, range_bins, beams);
            const int width = scene % 3 == 0 ? 0 : 40 + static_cast<int>(random() % 400);
            const FanMap map = make_fan_map(sonar, width);
            Ping ping;
            ping.range_bins = sonar.config.range_bins;
            ping.beams = sonar.config.azimuth_bins;
            ping.intensity.resize(static_cast<std::size_t>(ping.range_bins) * ping.beams);
            for (float& value : ping.intensity)
                value = static_cast<float>(uniform(0.0, 1.2));
            const std::vector<std::uint8_t> image = render_fan(map, ping, 1.0);
            std::size_t off_by_one = 0;
            std::size_t off_by_more = 0;
            for (std::size_t i = 0; i < image.size(); ++i) {
                if (!is_far_inside(sonar, map.frame, i)) continue;
                const int expected = direct_grey(sonar, map, ping, i);
                off_by_one += image[i] != expected;
                off_by_more += std::abs(image[i] - expected) > 1;
            }
            CAPTURE(scene);
            const auto line = static_cast<std::size_t>(map.frame.width);
            CHECK(off_by_more <= line);
            CHECK(off_by_one <= line + image.size() / 2000);
        }
    }
}
