#include "product/fan_style.h"

#include <doctest/doctest.h>

#include <algorithm>
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

TEST_SUITE("product") {
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

    TEST_CASE("fan style: without rings and bearings nothing is drawn over the fan") {
        const Sonar one = sonar();
        const FanFrame frame = fan_frame(one, 200);
        const FanStyle style = make_fan_style(one, frame, {FanColours::amber, false, false});
        CHECK(style.marks.empty());
        const std::vector<std::uint8_t> grey(static_cast<std::size_t>(frame.width) * frame.height,
                                             77);
        const Picture picture = styled_fan(style, grey);
        CHECK(std::ranges::all_of(picture.pixels,
                                  [&](const Rgb& c) { return c == style.colours[77]; }));
    }

    TEST_CASE("fan style: rings and bearings run where the range and the azimuth are theirs") {
        // 100 pixels are too few for numbers: what is drawn are lines. A pixel is 0.1 m. Axis marks
        // from 0.5 to 10 m, about five of them, are 2, 4, 6, 8 and 10 m; every 10 degrees there is
        // a bearing.
        const Sonar one = sonar();
        const FanFrame frame = fan_frame(one, 100);
        REQUIRE(frame.pixel_m == test::approx(0.1));
        const auto place = [&](std::int32_t index) {
            return fan_place(frame, 10.0, index % frame.width, index / frame.width);
        };
        const auto rings = marked(make_fan_style(one, frame, {FanColours::grey, true, false}));
        const auto bearings = marked(make_fan_style(one, frame, {FanColours::grey, false, true}));
        for (int index = 0; index < frame.width * frame.height; ++index) {
            const FanPlace at = place(index);
            if (!is_inside_sector(one.settings.view, at)) {
                CHECK_FALSE(rings.contains(index));
                CHECK_FALSE(bearings.contains(index));
                continue;
            }
            const double ring = 2.0 * std::max(1.0, std::round(at.range_m / 2.0));
            CHECK(rings.contains(index) == (std::fabs(at.range_m - ring) < 0.1));
            const double line = radians(10.0 * std::round(degrees(at.azimuth_rad) / 10.0));
            const double aside = at.range_m * std::fabs(std::sin(at.azimuth_rad - line));
            // Near the apex the next line may be as near.
            if (at.range_m > 2.0) CHECK(bearings.contains(index) == (aside < 0.1));
        }
    }

    TEST_CASE("fan style: numbers stand only where there is room, in front of everything") {
        const Sonar one = sonar();
        const FanStyleConfig both{FanColours::grey, true, true};
        const auto has_text = [&](int width) {
            const FanStyle style = make_fan_style(one, fan_frame(one, width), both);
            return std::ranges::any_of(style.marks,
                                       [](const FanStyle::Mark& m) { return m.share == 1.0F; });
        };
        CHECK_FALSE(has_text(100));
        CHECK(has_text(300));
    }
}
