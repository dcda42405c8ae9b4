#include "mission/differences.h"

#include <doctest/doctest.h>

#include <string>

namespace sonarsim {

TEST_SUITE_BEGIN("mission");

TEST_CASE("missions: the keys that differ are named, with both values") {
    const std::string one = "seed: 7\nwater: {ph: 8}\nlist: [1, 2]\nobjects: [{x: 1}, {x: 2}]\n";
    CHECK(differing_keys(one, one) == "");
    CHECK(differing_keys(one, "# a comment\n" + one) == "");
    const std::string other = "seed: 8\nwater: {}\nlist: [1, 3]\nobjects: [{x: 1}, {x: 5}]\n";
    CHECK(differing_keys(one, other) ==
          " (list: [1, 2] there, [1, 3] here; objects.1.x: 2 there, 5 here; seed: 7 there, 8 here; "
          "water.ph: 8 there, not given here)");
    CHECK(differing_keys(one, other + "a: 1\nb: 2\n").ends_with("; and 2 more)"));
    CHECK(differing_keys("objects: [{x: 1}]\n", "objects: []\n") ==
          " (objects: not given there, [] here; objects.0.x: 1 there, not given here)");
    CHECK(differing_keys("seed: [", one) == "");
}

TEST_SUITE_END();

}  // namespace sonarsim
