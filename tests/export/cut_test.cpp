#include "export/cut.h"

#include <doctest/doctest.h>

#include <random>
#include <set>

#include "format/coco_counts.h"

namespace sonarsim {

namespace {

using Place = std::pair<int, int>;  // column, row

/// The pixels of runs in a picture of this height.
std::set<Place> pixels_of(const std::vector<std::uint32_t>& runs, int height) {
    std::set<Place> pixels;
    int at = 0;
    bool inside = false;
    for (const std::uint32_t run : runs) {
        for (std::uint32_t k = 0; k < run; ++k, ++at) {
            if (inside) pixels.emplace(at / height, at % height);
        }
        inside = !inside;
    }
    return pixels;
}

/// A mask of any runs in a picture of width x height.
std::vector<std::uint32_t> random_runs(std::mt19937& random, int width, int height) {
    std::vector<std::uint32_t> runs;
    auto left = static_cast<std::uint32_t>(width * height);
    while (left > 0) {
        const std::uint32_t least = runs.empty() ? 0 : 1;
        const auto run = std::min(left, least + static_cast<std::uint32_t>(random() % 9));
        runs.push_back(run);
        left -= run;
    }
    return runs;
}

}  // namespace

TEST_SUITE("export") {
    TEST_CASE("cut_mask: the pixels of a frame and of its columns, at random") {
        std::mt19937 random(7);
        for (int round = 0; round < 300; ++round) {
            const int width = 1 + static_cast<int>(random() % 12);
            const int height = 1 + static_cast<int>(random() % 12);
            const std::vector<std::uint32_t> runs = random_runs(random, width, height);
            const ObjectMask whole = mask_of_runs(runs, height);
            const std::set<Place> pixels = pixels_of(runs, height);
            REQUIRE(whole.area == pixels.size());
            REQUIRE(pixels_of(whole.runs, height) == pixels);
            Frame frame;
            frame.left = static_cast<int>(random() % width);
            frame.right = frame.left + 1 + static_cast<int>(random() % (width - frame.left));
            frame.top = static_cast<int>(random() % height);
            frame.bottom = frame.top + 1 + static_cast<int>(random() % (height - frame.top));
            const int from = static_cast<int>(random() % width);
            const int to = from + static_cast<int>(random() % (width - from + 1));
            const ObjectMask cut = cut_mask(whole, height, frame, from, to);
            std::set<Place> expected;
            int right = 0, bottom = 0;
            for (const auto& [x, y] : pixels) {
                const bool is_in = x >= frame.left && x < frame.right && y >= frame.top &&
                                   y < frame.bottom && x >= from && x < to;
                if (!is_in) continue;
                expected.emplace(x - frame.left, y - frame.top);
                right = std::max(right, x - frame.left + 1);
                bottom = std::max(bottom, y - frame.top + 1);
            }
            CHECK(pixels_of(cut.runs, frame.height()) == expected);
            CHECK(cut.area == expected.size());
            CHECK(cut.right == right);
            CHECK(cut.bottom == bottom);
        }
    }

    TEST_CASE("tile_begins: the whole length, with the overlap") {
        CHECK(tile_begins(10, 16, 4) == std::vector{0});
        CHECK(tile_begins(16, 16, 4) == std::vector{0});
        CHECK(tile_begins(17, 16, 4) == std::vector{0, 1});
        CHECK(tile_begins(40, 16, 4) == std::vector{0, 12, 24});
        CHECK(tile_begins(32, 16, 0) == std::vector{0, 16});
    }

    TEST_CASE("coco_runs: what coco_counts() wrote, and no other text") {
        std::mt19937 random(8);
        for (int round = 0; round < 300; ++round) {
            std::vector<std::uint32_t> runs{static_cast<std::uint32_t>(random() % 3)};
            std::uint64_t pixels = runs[0];
            for (int k = 0; k < round % 9; ++k) {
                runs.push_back(1 + static_cast<std::uint32_t>(random() % (1U << random() % 28)));
                pixels += runs.back();
            }
            const std::string text = coco_counts(runs);
            const auto found = coco_runs(text, pixels);
            REQUIRE(found);
            CHECK(*found == runs);
            CHECK_FALSE(coco_runs(text, pixels + 1));
            CHECK_FALSE(coco_runs(text + "0", pixels));
            // Any text gives runs of all pixels or nothing.
            std::string other = text;
            other[random() % other.size()] = static_cast<char>(random() % 256);
            if (const auto any = coco_runs(other, pixels)) {
                std::uint64_t sum = 0;
                for (const std::uint32_t run : *any)
                    sum += run;
                CHECK(sum == pixels);
            }
        }
        CHECK_FALSE(coco_runs("oooooooooooo0", 100));
        CHECK_FALSE(coco_runs("o", 100));
    }
}

}  // namespace sonarsim
