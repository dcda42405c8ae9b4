#include <doctest/doctest.h>

#include "support/sanitized.h"
#include "hard/cases.h"
#include "hard/tools.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("hard");

namespace {

void check(const std::vector<HardCase>& cases) {
    REQUIRE(!cases.empty());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        HardCase hard = cases[i];
        if (test::sanitized) {
            // Every fifth case, since a sanitizer takes minutes for them.
            if (i % 5 != 0) continue;
            // The expected images take most of the time; without them the invariants remain.
            hard.truth = {};
        }
        for (const HardResult& result : run_hard_case(hard)) {
            CAPTURE(result.name);
            CAPTURE(result.engine);
            CAPTURE(result.model);
            CAPTURE(result.sonar);
            CAPTURE(result.error);
            CAPTURE(result.bound);
            CAPTURE(result.broken);
            CHECK(result.broken.empty());
            // A known fault must still exist: a fixed one must leave the list.
            if (!test::sanitized) CHECK(result.holds() == result.known_fault.empty());
        }
    }
}

}  // namespace

TEST_CASE("hard cases: where the sonar is") {
    check(hard_places());
}
TEST_CASE("hard cases: geometry") {
    check(hard_geometry());
}
TEST_CASE("hard cases: numbers") {
    check(hard_numbers());
}
TEST_CASE("hard cases: limits of a sonar") {
    check(hard_sonar_limits());
}
TEST_CASE("hard cases: noise, streaks, multipath") {
    check(hard_noise());
}
TEST_CASE("hard cases: invariances") {
    check(hard_invariances());
}

TEST_CASE("hard cases: the table names every case and says when one fails") {
    HardResult result{"a case", "a thing", "dark", "rays", "paper", "imaging"};
    result.error = 0.5;
    result.bound = 0.1;
    CHECK(hard_table({result}).find("FAILS") != std::string::npos);
    CHECK(hard_table({result}).find("1 verdicts: 1 fail, 0 are known") != std::string::npos);
    result.known_fault = "too coarse";
    CHECK(hard_table({result}).find("known fault: too coarse") != std::string::npos);
    result.bound = 0.6;
    result.known_fault.clear();
    CHECK(hard_table({result}).find("0 fail") != std::string::npos);
    result.broken = "a pixel is negative";
    CHECK(hard_table({result}).find("FAILS: a pixel is negative") != std::string::npos);
}

TEST_SUITE_END();
