#include "simulate/product/bottom.h"
#include "simulate/product/contrast.h"
#include "simulate/product/picture.h"
#include "support/draws.h"

TEST_CASE("bottom: the leading edge, to the bin") {
    CHECK_FALSE(first_return({}));
    CHECK_FALSE(first_return(std::vector<float>(20, 0.0F)));
    // However short the echo is, and at either end.
    for (const int length : {1, 2, 3, 7}) {
        for (const int start : {0, 1, 5, 13}) {
            std::vector<float> column(20, 0.0F);
            std::fill_n(column.begin() + start, length, 0.3F);
            CAPTURE_ALL(length, start);
            CHECK(first_return(column) == start);
        }
    }
}

TEST_CASE("bottom: neither a target on it nor noise or the water's surface above it misleads") {
    // From bin 900 of 1,500, as 1 / r, with a wreck far out. Above it noise of a tenth or, at a
    // drawn bin, a surface of 2 to 4 times the water over 46 bins. Four looks.
    std::mt19937 random(3);
    std::gamma_distribution<double> speckle(4.0, 0.25);
    int wrong = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const int at = 150 + 3 * trial;
        std::vector<float> column(1500);
        for (int i = 0; i < 1500; ++i) {
            const double surface = trial % 4 * std::clamp((i - at) / 46.0 + 0.5, 0.0, 1.0);
            const double above = trial % 4 == 0 ? 1e-2 : 1e-3 * (1.0 + surface);
            const double bottom = 90.0 / i + (i >= 1200 && i < 1230 ? 0.4 : 0.0);
            column[i] = static_cast<float>((i < 900 ? above : bottom) * speckle(random));
        }
        wrong += std::abs(first_return_of_swath(column, at).value_or(-9) - 900) > 3;
    }
    CHECK(wrong <= 4);
}

TEST_CASE("bottom: a swath that is faint at nadir has its first return there") {
    // A beam that points to the side: the bottom from bin 400 of 1,500 on, 20 dB and then less
    // below its level; water 38 dB below; speckle.
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
        CHECK(first_return(column).value() > 440);
        const int first = first_return_of_swath(column).value();
        CHECK((400 <= first && first < 425));
    }
}

TEST_CASE("bottom: a swath of detected samples has its first return behind the ring-down") {
    // Amplitudes: the ring-down falls by a factor e in 4 bins, water and a bed that is 3 to 20
    // times as bright and brightens within 100 bins, both with a variation of 0.25 as the largest
    // of nine samples has it; the bed begins at a drawn bin or is out of range. Before the bed, in
    // half of the columns, a thing in the water that is up to four times as bright.
    std::mt19937 random(9);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int wrong = 0;
    int found = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const int begin = trial % 10 == 0 ? 1400 : 40 + static_cast<int>(900.0 * unit(random));
        const double bed = 3.0 * std::pow(20.0 / 3.0, unit(random));
        const bool has_thing = trial % 10 > 0 && begin > 250 && unit(random) < 0.5;
        const int thing = 60 + static_cast<int>((begin - 220) * unit(random));
        const int length = has_thing ? 5 + static_cast<int>(40.0 * unit(random)) : 0;
        const double echo = bed * (1.0 + 3.0 * unit(random));
        std::vector<float> column(1400);
        for (int i = 0; i < 1400; ++i) {
            const double slope = std::clamp((i - begin) / 100.0, 0.0, 1.0);
            const double mean = 1e3 * std::exp(-i / 4.0) + (i < begin ? 1.0 : bed * (1.0 + slope)) +
                                (thing <= i && i < thing + length ? echo : 0.0);
            column[i] = static_cast<float>(mean * std::exp(0.25 * normal(random)));
        }
        const std::optional<int> first = first_return_of_swath(column);
        if (begin == 1400)
            found += first.has_value();
        else
            wrong += std::abs(first.value_or(-9) - begin) > 3;
    }
    CHECK(found == 0);
    CHECK(wrong <= 3);
}

TEST_CASE("bottom: a swath without a bottom has no first return") {
    CHECK_FALSE(first_return_of_swath({}));
    CHECK_FALSE(first_return_of_swath(std::vector<float>(20, 0.0F)));
    CHECK_FALSE(first_return_of_swath(std::vector<float>(200, 0.3F)));
    std::vector<float> column(100, 0.05F);
    std::fill(column.begin() + 30, column.end(), 0.3F);
    CHECK(first_return_of_swath(column) == 30);
    column[20] = 0.12F;  // neither does a bin of noise change it
    CHECK(first_return_of_swath(column) == 30);
}

TEST_CASE("gain: one occupied value in a hundred is brighter, whatever the scale") {
    CHECK(Gain().white() == 1.0);
    for (const float scale : {1.0F, 0x1p-20F}) {
        Gain gain;
        std::vector<float> values(5000, 0.0F);
        for (int i = 1; i <= 1000; ++i)
            values.push_back(scale * static_cast<float>(i) * 1e-3F);
        gain.add(values);
        CHECK(gain.white() == approx(0.99 * static_cast<double>(scale)).epsilon(0.035));
    }
    CHECK(shade(0.25F, 1.0F) == 0.5F);
    CHECK(shade(7.0F, 1.0F) == 1.0F);
    CHECK(shade(-1.0F, 1.0F) == 0.0F);
}

TEST_CASE("picture: axis marks are round, nothing is drawn outside") {
    CHECK(round_up_125(1.0) == 1.0);
    CHECK(round_up_125(0.03) == approx(0.05));
    CHECK(round_down_125(4.9) == 2.0);
    CHECK(round_down_125(0.02) == approx(0.02));
    CHECK(axis_marks(-0.25, 0.35, 6.0) == std::vector<double>{-0.2, -0.1, 0.0, 0.1, 0.2, 0.3});
    Picture picture(10, 8, backdrop);
    fill(picture, -5, -5, 100, 6, ink);
    write(picture, 9, 4, "8", Align::left, ink);
    CHECK(std::ranges::count(picture.pixels, ink) == 10 + 2);  // a row, and the 8's left edge
}
