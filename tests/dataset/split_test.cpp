#include "dataset/split.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "core/error.h"

using namespace sonarsim;

namespace {

SplitConfig split(double train, double val, double test, int gap, int rounds) {
    SplitConfig config;
    config.train = train;
    config.val = val;
    config.test = test;
    config.gap = gap;
    config.rounds = rounds;
    return config;
}

/// A letter per pose: t, v, e (test) or '-'.
std::string letters(const SplitConfig& config, std::size_t poses) {
    std::string text;
    for (const SplitPart part : split_poses(config, poses))
        text += "tve-"[static_cast<std::size_t>(part)];
    return text;
}

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("split: stretches of the trajectory with gaps between them") {
        CHECK(letters(split(0.5, 0.25, 0.25, 2, 1), 20) == "ttttttttt--vvv--eeee");
        CHECK(letters(split(0.5, 0.0, 0.5, 1, 2), 12) == "ttt-ee-tt-ee");
        CHECK(letters(split(1.0, 0.0, 0.0, 5, 3), 6) == "tttttt");
        CHECK(letters(split(0.5, 0.5, 0.0, 0, 1), 5) == "tttvv");
    }

    TEST_CASE("split: shares are kept, and no two parts are neighbours") {
        for (const int rounds : {1, 3, 7}) {
            const SplitConfig config = split(0.8, 0.1, 0.1, 6, rounds);
            const auto parts = split_poses(config, 10'000);
            const auto count = [&](SplitPart part) {
                return static_cast<double>(std::ranges::count(parts, part));
            };
            CHECK(count(SplitPart::train) > 8000 - 6 * rounds - 1);
            CHECK(count(SplitPart::val) > 1000 - 6 * rounds - 1);
            CHECK(count(SplitPart::none) == 6 * (3 * rounds - 1));
            for (std::size_t k = 1; k < parts.size(); ++k) {
                if (parts[k] == parts[k - 1]) continue;
                const bool at_gap = parts[k] == SplitPart::none || parts[k - 1] == SplitPart::none;
                CHECK(at_gap);
            }
        }
    }

    TEST_CASE("split: fewer variants than parts are all in the first part") {
        const SplitConfig config = split(0.0, 0.5, 0.5, 10, 1);
        CHECK(split_variants(config, 1) == std::vector{SplitPart::val});
        CHECK(split_variants(config, 2) == std::vector{SplitPart::val, SplitPart::test});
        // The border at 2.7 is rounded to 3, so that nothing is left for the test.
        CHECK(split_variants(split(0.9, 0.0, 0.1, 0, 1), 3) == std::vector(3, SplitPart::train));
    }

    TEST_CASE("split: too few poses are refused") {
        const SplitConfig config = split(0.8, 0.1, 0.1, 10, 1);
        CHECK_THROWS_AS(split_poses(config, 6), InputError);
        CHECK_NOTHROW(split_poses(config, 200));
    }
}
