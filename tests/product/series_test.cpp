#include "simulate/product/contrast.h"
#include "simulate/product/picture.h"
#include "simulate/product/soundings.h"

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
