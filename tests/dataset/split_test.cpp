#include "dataset/split.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "core/error.h"

using namespace sonarsim;

namespace {

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
        CHECK(letters({.train = 0.5, .val = 0.25, .test = 0.25, .gap = 2, .rounds = 1}, 20) ==
              "ttttttttt--vvv--eeee");
        CHECK(letters({.train = 0.5, .val = 0.0, .test = 0.5, .gap = 1, .rounds = 2}, 12) ==
              "ttt-ee-tt-ee");
        CHECK(letters({.train = 1.0, .val = 0.0, .test = 0.0, .gap = 5, .rounds = 3}, 6) ==
              "tttttt");
        CHECK(letters({.train = 0.5, .val = 0.5, .test = 0.0, .gap = 0, .rounds = 1}, 5) ==
              "tttvv");
    }

    TEST_CASE("split: shares are kept, and no two parts are neighbours") {
        for (const int rounds : {1, 3, 7}) {
            const SplitConfig config{
                .train = 0.8, .val = 0.1, .test = 0.1, .gap = 6, .rounds = rounds};
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

    TEST_CASE("split: too few poses are refused") {
        const SplitConfig config{.train = 0.8, .val = 0.1, .test = 0.1};
        CHECK_THROWS_AS(split_poses(config, 6), InputError);
        CHECK_NOTHROW(split_poses(config, 200));
    }
}
