#include "core/lanes.h"
#include "simulate/calibrated/signal/normals.h"
#include "simulate/calibrated/speckle/speckle.h"
#include "support/test.h"

namespace {

/// A grid of random powers in the real parts; a share of the cells is empty, in runs.
EchoGrid random_powers(int rows, int columns, std::mt19937& random) {
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    EchoGrid grid(rows, columns);
    for (int c = 0; c < columns; ++c) {
        const int begin = static_cast<int>(unit(random) * static_cast<float>(rows));
        for (int row = begin; row < rows; ++row) {
            if (unit(random) < 0.2F) continue;
            grid.column(c)[2 * row] = unit(random) * unit(random);
        }
    }
    return grid;
}

std::vector<float> cells_of(const EchoGrid& grid, int column) {
    const float* const first = grid.column(column);
    return {first, first + std::ptrdiff_t{2} * grid.rows()};
}

}  // namespace

TEST_CASE("normal draws of eight words at a time are those of single words") {
    std::mt19937 random(13);
    for (int k = 0; k < 100'000; k += 8) {
        std::array<std::uint32_t, 8> words;
        for (std::uint32_t& word : words)
            word = static_cast<std::uint32_t>(random());
        // The greatest and the least radius, the first and the last angle.
        if (k == 0) words = {0U, 0xFFFU, 0xFFFFF000U, 0xFFFFFFFFU, 0x800U, 0x7FFU, 1U, 0x1000U};
        const Complexes8 draws = complex_normals(load_words(words.data()));
        std::array<float, 8> re, im;
        draws.re.store(re.data());
        draws.im.store(im.data());
        for (int lane = 0; lane < 8; ++lane) {
            const NormalPair one = normal_pair(words[lane]);
            REQUIRE(re[lane] == one.first);
            REQUIRE(im[lane] == one.second);
        }
    }
}

TEST_CASE("speckle of many bins at a time is that of single bins, for any number of bins") {
    std::mt19937 random(11);
    for (const int rows : {1, 5, 8, 13, 64, 100, 127}) {
        CAPTURE(rows);
        EchoGrid grid = random_powers(rows, 3, random);
        const EchoGrid before = grid;
        const PhiloxKey key{static_cast<std::uint32_t>(random()),
                            static_cast<std::uint32_t>(random())};
        constexpr float gain = 1.3F;
        // The bin behind the last one takes shares of echoes; it must stay as it is.
        const auto behind = std::ptrdiff_t{2} * rows;
        grid.column(1)[behind] = 0.75F;
        draw_speckle(grid, gain, key);
        CHECK(grid.column(1)[behind] == 0.75F);
        for (int c = 0; c < 3; ++c) {
            std::vector<float> expected = cells_of(before, c);
            for (int row = 0; row < rows; ++row) {
                // Eight bins have the first words of their counters, the next eight the second.
                std::array<std::uint32_t, 8> a{}, b{};
                const bool is_second = row % 16 >= 8;
                a[0] = static_cast<std::uint32_t>(is_second ? row - 8 : row);
                b[0] = static_cast<std::uint32_t>(c);
                philox_pairs(a.data(), b.data(), 8, key);
                const NormalPair draw = normal_pair(is_second ? b[0] : a[0]);
                const std::size_t at = static_cast<std::size_t>(2) * row;
                const float amplitude = std::sqrt(0.5F * gain * expected[at]);
                expected[at] = amplitude * draw.first;
                expected[at + 1] = amplitude * draw.second;
            }
            CHECK(cells_of(grid, c) == expected);
        }
    }
}
