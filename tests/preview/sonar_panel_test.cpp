#include "run/preview/preview.h"
#include "simulate/product/fan.h"
#include "support/sonars.h"

namespace {

Ping one_bin(const Sonar& sonar, int bin, int beam, float intensity) {
    Ping ping = even_ping(sonar, 0.0F);
    ping.intensity[static_cast<std::size_t>(bin) * ping.beams + beam] = intensity;
    return ping;
}

int brightness(const Rgb& colour) {
    return colour.r + colour.g + colour.b;
}

/// 90 degrees to 10 m, beams of 1 degree and bins of 0.1 m.
Sonar imaging() {
    SonarConfig config = default_sonar(SonarKind::imaging);
    config.azimuth_deg = 90.0;
    config.azimuth_bins = 90;
    set_range(config, 0.0, 10.0, 100);
    return make_sonar(config, {});
}

}  // namespace

TEST_CASE("sonar panel: the ping at a pose is the last one at or before it") {
    Sonar sonar = imaging();
    sonar.config.every = 3;
    CHECK(ping_at(sonar, 5) == 3);
    CHECK(ping_at(sonar, 6) == 6);
}

TEST_CASE("sonar panel: a fan fits, and an echo to port lies to the left at its range") {
    const Sonar sonar = imaging();
    // Beam 74 has its middle 29.5 degrees to port, bin 62 at 6.25 m; rings are at 2, 4, ... m.
    const auto render = [&](std::uint32_t) { return one_bin(sonar, 62, 74, 3.0F); };
    Picture picture = draw_sonar(sonar, 7, 20, render, 600, 420).picture;
    CHECK(picture.width <= 600);
    CHECK(picture.height <= 420);
    CHECK(std::max(picture.width / 600.0, picture.height / 420.0) > 0.99);
    const FanFrame frame = fan_frame(sonar, picture.width);
    const double azimuth = radians(29.5);
    const int x = static_cast<int>(0.5 * frame.width - 6.25 * std::sin(azimuth) / frame.pixel_m);
    const int y = static_cast<int>((10.0 - 6.25 * std::cos(azimuth)) / frame.pixel_m);
    // Amber is the redder the brighter, rings and bearings are blue. A bin is 4 pixels long.
    const auto brightest =
        std::ranges::max_element(picture.pixels, {}, &Rgb::r) - picture.pixels.begin();
    CHECK(std::abs(brightest % picture.width - x) <= 3);
    CHECK(std::abs(brightest / picture.width - y) <= 3);
    // Rings are at 2, 4, 6 and 8 m. Bearings are drawn every 10 degrees: none at -5.
    const double between = radians(-5.0);
    const auto at = [&](double range) {
        return brightness(picture.row(
            static_cast<int>((10.0 - range * std::cos(between)) / frame.pixel_m))[static_cast<int>(
            0.5 * frame.width - range * std::sin(between) / frame.pixel_m)]);
    };
    for (double range = 1.0; range < 9.0; range += 1.0)
        CHECK((at(range) > at(range + 0.5) + 60) == (std::fmod(range, 2.0) == 0.0));
}

TEST_CASE("sonar panel: a waterfall has port on the left, a row per ping and marks at this one") {
    SonarConfig config = default_sonar(SonarKind::sidescan);
    set_range(config, 0.5, 20.0, 390);  // bins of 0.05 m
    const Sonar sonar = make_sonar(config, {});
    // Port (beam 1) sees something at 10 m, in the fourth of ten pings alone.
    const auto render = [&](std::uint32_t pose) {
        return pose == 3 ? one_bin(sonar, 190, 1, 1.0F) : even_ping(sonar, 0.0F);
    };
    Picture picture = draw_sonar(sonar, 7, 10, render, 600, 420).picture;
    REQUIRE(picture.width == 600);
    // 400 rows for ten pings, 600 columns for 40 m: a column shows 0.067 m.
    std::set<int> rows;
    std::set<int> columns;
    for (int y = 15; y < 400; ++y) {  // below the words
        for (int x = 20; x < 580; ++x) {
            if (brightness(picture.row(y)[x]) < 300) continue;
            rows.insert(y);
            columns.insert(x);
        }
    }
    REQUIRE(!rows.empty());
    CHECK(*rows.begin() == 120);
    CHECK(*rows.rbegin() == 159);
    CHECK(rows.size() == 40);
    CHECK(columns.size() <= 2);
    CHECK(std::abs(*columns.begin() - 150) <= 1);  // 10 of 20 m to port
    // Ping 7 is in the middle of rows 280 to 319.
    for (const int y : {299, 300, 301})
        CHECK((picture.row(y)[3] == mark_colour) == (y == 300));
}
