#include "simulate/product/contrast.h"
#include "support/test.h"

TEST_CASE("contrast: the level of an object over that next to it at the same range") {
    // 9 lines of 3 bins. The background grows tenfold from bin to bin, as with range; the
    // object, lines 4 and 5 of the bins 0 and 1, is four times as bright: 6.0 dB.
    LevelMap map{9, 3, {}, {}, {}};
    std::vector<std::uint16_t> object(27, 1);
    std::vector<std::uint16_t> shadow(27, 0);
    std::vector<float> level(27);
    for (std::size_t line = 0; line < 9; ++line) {
        for (std::size_t bin = 0; bin < 3; ++bin) {
            const bool is_object = bin < 2 && (line == 4 || line == 5);
            level[3 * line + bin] = (bin == 0 ? 1.0F : 10.0F) * (is_object ? 4.0F : 1.0F);
            if (is_object) object[3 * line + bin] = 2;
        }
    }
    // Another object next to it, bright, and a dark shadow of that: neither counts.
    object[3 * 3 + 0] = 3;
    level[3 * 3 + 0] = 1000.0F;
    shadow[3 * 6 + 1] = 3;
    level[3 * 6 + 1] = 0.0F;
    map.object = object;
    map.shadow = shadow;
    map.level = level;
    const std::vector<std::uint8_t> is_background{1, 1, 0, 0};
    const BinBox box{4, 5, 0, 1};
    const auto found = contrast_db(map, map.object, 2, box, is_background);
    REQUIRE(found.has_value());
    CHECK(*found == approx(6.0206).epsilon(1e-4));
    // Nothing next to it but its like: no surroundings.
    std::ranges::fill(object, std::uint16_t{2});
    CHECK_FALSE(contrast_db(map, map.object, 2, {0, 8, 0, 2}, is_background).has_value());
}

TEST_CASE("contrast: in a full turn the surroundings go on over the seam") {
    // 12 lines of a bin. The object has the lines 11 and 0 and the level 8. Next to it the
    // background has 2, and 100 on the other side of the turn: 6.0 dB.
    std::vector<std::uint16_t> object(12, 1);
    std::vector<float> level(12, 100.0F);
    for (const std::size_t line : {9, 10, 1, 2})
        level[line] = 2.0F;
    const auto contrast_of = [&](bool full_turn, const BinBox& box) {
        const LevelMap map{12, 1, object, {}, level, full_turn};
        const std::vector<std::uint8_t> is_background{1, 1, 0};
        return contrast_db(map, map.object, 2, box, is_background).value();
    };
    object[11] = object[0] = 2;
    level[11] = level[0] = 8.0F;
    CHECK(contrast_of(true, {0, 11, 0, 0}) == approx(6.0206).epsilon(1e-4));
    CHECK(over_seam({12, 1, object, {}, level, true}, object, 2, {0, 11, 0, 0}).first_line == -1);
    // Without a seam the object is as wide as the picture: 8 over (4 x 2 + 6 x 100) / 10.
    CHECK(contrast_of(false, {0, 11, 0, 0}) == approx(-8.8081).epsilon(1e-4));
    // An object of the line 0 alone: 11 is background as dark as 10.
    object[11] = 1;
    level[11] = 2.0F;
    level[1] = level[2] = 6.0F;
    CHECK(contrast_of(true, {0, 0, 0, 0}) == approx(3.0103).epsilon(1e-4));
    CHECK(contrast_of(false, {0, 0, 0, 0}) == approx(1.2494).epsilon(1e-4));
}

// 40 ranges of 13 lines with exponential speckle of the mean 1; behind them noise of the same mean
// hides the shadow of lines 5 to 7, which is empty up to range 24.
TEST_CASE("contrast: a shadow ends where it looks like its surroundings") {
    constexpr int bins = 40;
    std::mt19937 random(7);
    std::exponential_distribution<float> speckle(1.0F);
    const std::vector<std::uint16_t> object(std::size_t{13} * bins, 0);
    const std::vector<std::uint8_t> is_background{1, 0, 0};
    double mean = 0.0;
    for (int trial = 0; trial < 100; ++trial) {
        std::vector<std::uint16_t> shadow(object.size(), 0);
        std::vector<float> level(object.size());
        for (int k = 0; k < std::ssize(level); ++k) {
            const int line = k / bins;
            const bool is_shadow = line >= 5 && line <= 7;
            if (is_shadow) shadow[k] = 1;
            level[k] = is_shadow && k % bins < 25 ? 0.0F : speckle(random);
        }
        const LevelMap map{13, bins, object, shadow, level};
        const std::vector<std::uint16_t> found = visible_shadows(map, {{0, 1, 0}}, is_background);
        const auto left = std::ranges::count(found, 1);
        CHECK(left >= 3 * 25);
        mean += static_cast<double>(left) / (3 * 100);
        CHECK(visible_shadows(map, {{0, 0, 1}}, is_background) == object);
    }
    CHECK(mean < 28.0);  // ranges; by chance some are dark
}
