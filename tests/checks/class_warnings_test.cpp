#include <doctest/doctest.h>

#include <string>

#include "checks/find_warnings.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("checks");

namespace {

/// The warnings about a class that this many of the pictures show.
std::vector<Warning> warnings_of(std::uint64_t shown, std::uint64_t pictures) {
    PictureTally tally;
    tally.pictures = pictures;
    ClassTally& one = tally.classes.emplace_back();
    one.name = "mine";
    one.pictures = shown;
    return class_warnings(tally);
}

}  // namespace

TEST_CASE("class warnings: at most ten pictures, and at most one in ten") {
    CHECK(warnings_of(10, 100).size() == 1);
    CHECK(warnings_of(11, 1000).empty());  // more than ten
    CHECK(warnings_of(10, 99).empty());    // more than one in ten
    CHECK(warnings_of(1, 10).size() == 1);
    CHECK(warnings_of(1, 9).empty());
    CHECK(warnings_of(0, 1).size() == 1);
    CHECK(warnings_of(0, 0).empty());
    const std::vector<Warning> found = warnings_of(3, 200);
    REQUIRE(found.size() == 1);
    CHECK(sentence(found[0]).starts_with(
        "W33 labels: hardly any of 200 pictures shows an object of these classes: 'mine' (3); "));
}

TEST_CASE("class warnings: one for all classes, with the names of the first") {
    PictureTally tally;
    tally.pictures = 50;
    for (int k = 0; k < 8; ++k) {
        ClassTally& one = tally.classes.emplace_back();
        one.name = "class_" + std::to_string(k);
        one.pictures = k == 3 ? 40 : 0;
    }
    const std::vector<Warning> found = class_warnings(tally);
    REQUIRE(found.size() == 1);
    CHECK(
        found[0].what.ends_with("'class_0' (0), 'class_1' (0), 'class_2' (0), 'class_4' (0), "
                                "'class_5' (0) and 2 classes more"));
}
