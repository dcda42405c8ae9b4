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
            // Here the octree takes two minutes under a sanitizer.
            if (hard.name == "8,192 range bins") continue;
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

TEST_CASE("hard cases: what a mission would be refused for") {
    // A floor and a quick view, since only the refusals matter.
    HardCase hard{"180 degrees", "", "", plain_floor, [](SonarKind kind) {
                      return over_floor(kind, [](SonarConfig& c) {
                          c.elevation_deg = 180.0;
                          c.opening_deg = 180.0;
                      });
                  }};
    hard.octree_may_refuse = true;
    const std::vector<HardResult> results = run_hard_case(hard);
    CHECK(results[0].refused.empty());
    CHECK(results[1].refused.find("octree takes elevation_deg up to 160, not 180") !=
          std::string::npos);
    CHECK(results[1].holds());
    // A refusal that the case does not allow is a failure.
    hard.octree_may_refuse = false;
    CHECK(!run_hard_case(hard)[1].holds());
    // A case that is not refused is compared: here with an image that cannot match.
    hard.octree_may_refuse = true;
    hard.trial = [](SonarKind kind) { return over_floor(kind); };
    hard.truth = dark;
    const HardResult accepted = run_hard_case(hard)[1];
    CHECK(accepted.refused.empty());
    CHECK(!accepted.holds());
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
    result.broken.clear();
    result.refused = "the angle";
    CHECK(hard_table({result}).find("refused: the angle\n") != std::string::npos);
    CHECK(hard_table({result}).find("0 fail, 0 are known faults, 1 refused") != std::string::npos);
}

TEST_SUITE_END();
