#include "preview/fan_style.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "core/units.h"
#include "sonar/sonar.h"
#include "support/approx.h"

using namespace sonarsim;

namespace {

/// 60 degrees to 10 m.
Sonar sonar() {
    SonarConfig config;
    config.name = "test";
    config.azimuth_deg = 60.0;
    config.range_min_m = 0.5;
    config.range_max_m = 10.0;
    return make_sonar(config, {});
}

std::set<std::int32_t> marked(const FanStyle& style) {
    std::set<std::int32_t> pixels;
    for (const FanStyle::Mark& mark : style.marks)
        pixels.insert(mark.index);
    return pixels;
}

}  // namespace

TEST_SUITE("preview") {
    TEST_CASE("fan style: colours grow brighter with the grey value, and grey stays grey") {
        // Rec. 709: how bright a colour looks.
        const auto luminance = [](const Rgb& c) {
            return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
        };
        for (const FanColours colours :
             {FanColours::grey, FanColours::copper, FanColours::amber, FanColours::sea}) {
            const ColourTable table = colour_table(colours);
            for (std::size_t k = 1; k < table.size(); ++k)
                CHECK(luminance(table[k]) >= luminance(table[k - 1]));
            CHECK(luminance(table.back()) - luminance(table.front()) > 150.0);
        }
        const ColourTable grey = colour_table(FanColours::grey);
        for (int k = 0; k < 256; ++k) {
            const auto level = static_cast<std::uint8_t>(k);
            CHECK(grey[k] == Rgb{level, level, level});
        }
    }

    TEST_CASE("fan style: lines run where the range or the azimuth is theirs") {
        // A pixel is 0.1 m. Axis marks from 0.5 to 10 m, about five of them, are 2, 4, 6, 8 and 10
        // m; every 10 degrees there is a bearing.
        const Sonar one = sonar();
        const FanFrame frame = fan_frame(one, 100);
        REQUIRE(frame.pixel_m == test::approx(0.1));
        const auto lines = marked(make_fan_style(one, frame));
        for (int index = 0; index < frame.width * frame.height; ++index) {
            const FanPlace at = fan_place(frame, 10.0, index % frame.width, index / frame.width);
            if (!is_inside_sector(one.settings.view, at)) {
                CHECK_FALSE(lines.contains(index));
                continue;
            }
            const double ring = 2.0 * std::max(1.0, std::round(at.range_m / 2.0));
            const double line = radians(10.0 * std::round(degrees(at.azimuth_rad) / 10.0));
            const double aside = at.range_m * std::fabs(std::sin(at.azimuth_rad - line));
            // Near the apex the next line may be as near.
            if (at.range_m > 2.0)
                CHECK(lines.contains(index) == (std::fabs(at.range_m - ring) < 0.1 || aside < 0.1));
        }
    }

    TEST_CASE("fan style: numbers stand only where there is room") {
        const Sonar one = sonar();
        CHECK(fan_numbers(one, fan_frame(one, 100)).empty());
        CHECK_FALSE(fan_numbers(one, fan_frame(one, 300)).empty());
    }
}
