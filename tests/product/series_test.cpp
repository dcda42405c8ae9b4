#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/units.h"
#include "product/bottom.h"
#include "product/echogram.h"
#include "product/gain.h"
#include "product/picture.h"
#include "product/sidescan_row.h"
#include "product/waterfall.h"
#include "sonar/kinds.h"
#include "support/approx.h"
#include "support/sonars.h"

using namespace sonarsim;
using sonarsim::test::sidescan_row;

namespace {

SonarConfig sidescan(int range_bins) {
    SonarConfig config = default_sonar(SonarKind::sidescan);
    config.name = "sss";
    config.range_min_m = 0.0;
    config.range_max_m = 30.0;
    config.range_bins = range_bins;
    return config;
}

}  // namespace

TEST_SUITE("product") {
    TEST_CASE("row: port from far to near, then starboard from near to far, linear through nadir") {
        Ping ping;
        ping.range_bins = 3;
        ping.beams = 2;
        ping.intensity = {1, 10, 2, 20, 3, 30};  // starboard 1 2 3, port 10 20 30
        SonarConfig config = sidescan(3);        // bins of 10 m
        CHECK(sidescan_row(config, ping) == std::vector<float>{30, 20, 10, 1, 2, 3});
        // 20 m to 26 m in bins of 2 m: ten bins from nadir to range_min.
        config.range_min_m = 20.0;
        config.range_max_m = 26.0;
        REQUIRE(waterfall_columns(config) == 26);
        const std::vector<float> row = sidescan_row(config, ping);
        for (int k = 0; k < 26; ++k) {
            // Linear through nadir: column k shows |k + 0.5 - 13| columns of 2 m.
            const double range = 2.0 * std::fabs(k + 0.5 - 13.0);
            const int bin = static_cast<int>(std::floor((range - 20.0) / 2.0));
            CHECK(row[k] == (range < 20.0 ? 0.0F : ping.at(bin, k < 13 ? 1 : 0)));
        }
    }

    TEST_CASE("bottom: the leading edge, to the bin") {
        CHECK_FALSE(first_return({}, 0.0));
        CHECK_FALSE(first_return(std::vector<float>(20, 0.0F), 0.1));
        // However short the echo is, and at either end.
        for (const int length : {1, 2, 3, 7}) {
            for (const int start : {0, 1, 5, 13}) {
                std::vector<float> column(20, 0.0F);
                std::fill_n(column.begin() + start, length, 0.3F);
                CAPTURE(length);
                CAPTURE(start);
                CHECK(first_return(column, 0.0) == start);
                CHECK(first_return(column, 0.1) == start);
            }
        }
    }

    TEST_CASE("bottom: neither a bright target on it nor noise above it misleads") {
        // R H / r from bin 60 of 400, a wreck four times as bright far out; noise of a tenth of
        // the bottom's nearest echo over everything. The running mean of three Rayleigh values of
        // mean m has a deviation of 0.3 m: to reach half of the level is 10 of those away.
        std::mt19937 random(5);
        std::uniform_real_distribution<double> unit(1e-9, 1.0);
        int worst = 0;
        for (int trial = 0; trial < 200; ++trial) {
            std::vector<float> column(400);
            for (int i = 0; i < 400; ++i) {
                const double bottom = i < 60 ? 0.0 : 0.2 * 60.0 / i;
                const double wreck = i >= 250 && i < 270 ? 0.8 : 0.0;
                const double noise = 0.016 * std::sqrt(-2.0 * std::log(unit(random)));
                column[i] = static_cast<float>(bottom + wreck + noise);
            }
            worst = std::max(worst, std::abs(first_return(column, 0.1).value() - 60));
        }
        CHECK(worst <= 1);
    }

    TEST_CASE("bottom: a swath that is faint at nadir has its first return there") {
        // As a side-scan sonar whose beam points to the side: the bottom from bin 400 of 1,500 on,
        // first 20 dB and then less below its level; the water 38 dB below. Speckle over all.
        std::mt19937 random(7);
        std::exponential_distribution<double> speckle;
        for (int trial = 0; trial < 200; ++trial) {
            std::vector<float> column(1500);
            for (int i = 0; i < 1500; ++i) {
                const double beam = std::clamp((i - 390) / 150.0, 0.0, 1.0);
                const double mean = i < 400 ? 1.5e-4 : 0.01 + beam * beam;
                column[i] = static_cast<float>(mean * speckle(random));
            }
            CAPTURE(trial);
            CHECK(first_return(column, 0.1).value() > 440);
            const int first = first_return_of_swath(column).value();
            CHECK((400 <= first && first < 425));
        }
    }

    TEST_CASE("bottom: the first return of a swath under noise is that at half of the level") {
        CHECK_FALSE(first_return_of_swath({}));
        CHECK_FALSE(first_return_of_swath(std::vector<float>(20, 0.0F)));
        std::vector<float> column(100, 0.05F);
        std::fill(column.begin() + 30, column.end(), 0.3F);
        CHECK(first_return_of_swath(column) == 30);
        column[20] = 0.12F;  // neither does a bin of noise change it
        CHECK(first_return_of_swath(column) == 30);
    }

    TEST_CASE("gain: one occupied value in a hundred is brighter") {
        Gain gain;
        CHECK(gain.white() == 1.0);
        std::vector<float> values(5000, 0.0F);
        for (int i = 1; i <= 1000; ++i)
            values.push_back(static_cast<float>(i) * 1e-3F);
        gain.add(values);
        CHECK(gain.white() == test::approx(0.99).epsilon(0.035));
        CHECK(shade(0.25F, 1.0F) == 0.5F);
        CHECK(shade(7.0F, 1.0F) == 1.0F);
        CHECK(shade(-1.0F, 1.0F) == 0.0F);
    }

    TEST_CASE("picture: axis marks are round, colours are blended, nothing is drawn outside") {
        CHECK(round_up_125(1.0) == 1.0);
        CHECK(round_up_125(1.1) == 2.0);
        CHECK(round_up_125(0.03) == test::approx(0.05));
        CHECK(round_up_125(60.0) == 100.0);
        CHECK(round_down_125(1.0) == 1.0);
        CHECK(round_down_125(4.9) == 2.0);
        CHECK(round_down_125(0.07) == test::approx(0.05));
        CHECK(round_down_125(0.02) == test::approx(0.02));
        CHECK(round_down_125(60.0) == 50.0);
        CHECK(axis_marks(0.5, 10.0, 4.0) == std::vector<double>{5.0, 10.0});
        CHECK(axis_marks(-0.25, 0.35, 6.0) == std::vector<double>{-0.2, -0.1, 0.0, 0.1, 0.2, 0.3});
        const Rgb stops[] = {{0, 0, 0}, {200, 100, 0}, {200, 100, 200}};
        CHECK(blend(stops, 0.25F) == Rgb{100, 50, 0});
        CHECK(blend(stops, 1.0F) == stops[2]);
        CHECK(blend(stops, 9.0F) == stops[2]);
        Picture picture(10, 8, backdrop);
        fill(picture, -5, -5, 100, 6, ink);
        write(picture, 9, 4, "8", Align::left, ink);
        CHECK(std::ranges::count(picture.pixels, ink) == 10 + 2);  // a row, and the 8's left edge
    }

    TEST_CASE("waterfall: bright copper where it echoes, marks at their ranges") {
        const SonarConfig config = sidescan(300);  // 10 cm
        const StripFrame frame = waterfall_frame(config, 7);
        CHECK(frame.height == frame.axis_height + 7);
        Picture axis = waterfall_axis(config, frame);
        CHECK(axis.width == 601);
        const Rgb* const ticks = axis.row(axis.height - 3);
        // 10 m to starboard is bin 100, pixel 301 + 100, after the line; to port 299 - 100.
        CHECK(ticks[401] == ink);
        CHECK(ticks[199] == ink);
        CHECK(ticks[450] == backdrop);
        std::vector<float> row(600, 0.0F);
        row[10] = 0.5F;
        row[20] = 0.125F;
        row[299] = row[300] = 0.5F;
        std::vector<Rgb> pixels(601);
        waterfall_row(row, 0.5, frame, pixels);
        CHECK(pixels[0] == Rgb{0, 0, 0});
        CHECK(pixels[10] == Rgb{255, 199, 127});
        CHECK(pixels[20].r > pixels[20].g);  // copper
        CHECK(pixels[20].g > pixels[20].b);
        CHECK(pixels[300].b > pixels[300].r);  // the line at nadir
        CHECK(pixels[299] == pixels[10]);      // the line hides no bin
        CHECK(pixels[301] == pixels[10]);
    }

    TEST_CASE("echogram: the depth axis fits the rows") {
        SonarConfig config = default_sonar(SonarKind::echosounder);
        config.range_min_m = 0.0;
        config.range_max_m = 10.0;
        const StripFrame frame = echogram_frame(config, 100);  // 200 bins
        CHECK(frame.bin_px == 2);
        CHECK(frame.ping_px == 6);
        CHECK(frame.height == 400);
        CHECK(frame.width == frame.axis_width + 600);
        Picture axis = echogram_axis(config, frame);
        // 4 m is at row 160; marks are 2 m apart.
        CHECK(axis.row(160)[frame.axis_width - 4] == ink);
        CHECK(axis.row(120)[frame.axis_width - 4] == backdrop);
        std::vector<Rgb> pixels(12);
        echogram_row(std::vector<float>{0.0F, 1.0F}, 1.0, frame, pixels);
        CHECK(pixels[5].b > pixels[5].r);
        CHECK(pixels[6].r > pixels[6].b);
        CHECK(pixels[6] == pixels[11]);
    }
}
