#include "simulate/product/fan.h"
#include "support/sonars.h"

namespace {

Sonar fan_sonar(double azimuth_deg, bool equal_azimuth = true) {
    SonarConfig config;
    config.azimuth_deg = azimuth_deg;
    set_range(config, 1.0, 10.0, 90);
    config.azimuth_bins = 40;
    if (!equal_azimuth) {
        config.model = ModelKind::calibrated;
        config.instrument.beam.spread = BeamSpacing::equal_sine;
    }
    return make_sonar(config, {});
}

}  // namespace

TEST_CASE("fan of ids: a pixel has the bin that its centre lies in") {
    for (const auto& fan_of :
         {std::pair{30.0, true}, {120.0, true}, {120.0, false}, {270.0, true}, {360.0, true}}) {
        const double azimuth_deg = fan_of.first;
        const bool equal_azimuth = fan_of.second;
        CAPTURE_ALL(azimuth_deg, equal_azimuth);
        const Sonar sonar = fan_sonar(azimuth_deg, equal_azimuth);
        const FanBins fan = make_fan_bins(sonar);
        std::size_t inside = 0;
        for (int row = 0; row < fan.frame.height; ++row) {
            for (int column = 0; column < fan.frame.width; ++column) {
                const auto at = static_cast<std::size_t>(row) * fan.frame.width + column;
                const std::int32_t bin = fan.by_row[at];
                CHECK(bin ==
                      fan.by_column[static_cast<std::size_t>(column) * fan.frame.height + row]);
                // Ahead is up, port on the left.
                const double x = 10.0 - (row + 0.5) * fan.frame.pixel_m;
                const double y = (0.5 * fan.frame.width - column - 0.5) * fan.frame.pixel_m;
                const double range = std::hypot(x, y);
                const double azimuth = std::atan2(y, x);
                const double half = 0.5 * radians(azimuth_deg);
                constexpr double margin = 1e-9;
                if (range < 1.0 - margin || range > 10.0 + margin ||
                    std::fabs(azimuth) > half + margin) {
                    CHECK(bin == -1);
                    continue;
                }
                if (bin < 0) continue;  // on an edge
                ++inside;
                const int i = bin % 90;
                const int j = bin / 90;
                CHECK(range >= sonar.range_edges_m[i] - margin);
                CHECK(range <= sonar.range_edges_m[i + 1] + margin);
                CHECK(azimuth >= sonar.azimuth_edges_rad[j] - margin);
                CHECK(azimuth <= sonar.azimuth_edges_rad[j + 1] + margin);
            }
        }
        // The area of the sector, r^2 a / 2, in pixels.
        const double area = 0.5 * (100.0 - 1.0) * radians(azimuth_deg);
        const double pixels = area / (fan.frame.pixel_m * fan.frame.pixel_m);
        CHECK(inside / pixels == approx(1.0).epsilon(0.01));
    }
}

TEST_CASE("fan of ids: the box of a bin holds its pixels and no others around them") {
    const FanBins fan = make_fan_bins(fan_sonar(120.0));
    std::vector<PixelBox> boxes(fan.boxes.size());
    for (int row = 0; row < fan.frame.height; ++row) {
        for (int column = 0; column < fan.frame.width; ++column) {
            const auto at = static_cast<std::size_t>(row) * fan.frame.width + column;
            if (fan.by_row[at] < 0) continue;
            PixelBox& box = boxes[static_cast<std::size_t>(fan.by_row[at])];
            box = joined(box, {column, column + 1, row, row + 1});
        }
    }
    CHECK(boxes.size() == 90 * 40);
    CHECK(fan.boxes == boxes);
    CHECK(joined(boxes.front(), {}) == boxes.front());  // a bin without pixels
}
