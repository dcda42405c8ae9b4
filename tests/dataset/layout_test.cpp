#include "dataset/layout.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "support/small_mission.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

Layout layout_of(const Mission& mission, int poses) {
    const Assembly assembly = small_assembly(mission, poses);
    return make_layout(mission, make_writers(mission, assembly), poses);
}

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("layout: files bear the pose's index in six digits, or as many as it takes") {
        Layout layout = layout_of(small_mission("out"), 1);
        CHECK(layout.file({7, 0}, {"polar", ".npy"}) == "out/front/polar/000007.npy");
        CHECK(layout.file({7, 1}, {"fan", ".png"}) == "out/left/fan/000007.png");
        CHECK(layout.file({999'999, 1}, {"meta", ".json"}) == "out/left/meta/999999.json");
        const Mission mission = small_mission("out");
        CHECK(make_layout(mission, {}, 1'000'000).number(7) == "000007");
        CHECK(make_layout(mission, {}, 1'000'001).number(7) == "0000007");
        CHECK(make_layout(mission, {}, 0).number(0) == "000000");
    }

    TEST_CASE("layout: records are counted by the pings of their sensor") {
        const Layout layout = layout_of(survey_mission("out"), 7);
        REQUIRE(layout.sensors.size() == 4);
        // The sounder pings at poses 0, 2, 4 and 6.
        CHECK(layout.sensors[3].pings == 4);
        CHECK(layout.record_of({6, 3}) == 3);
    }

    TEST_CASE("layout: a sensor with `every: 3` pings at poses 0, 3, 6, ...") {
        const std::vector<PingId> expected{{0, 0}, {0, 1}, {1, 0}, {2, 0}, {3, 0}, {3, 1}};
        CHECK(list_pings(small_mission("out"), 4) == expected);
        CHECK(list_pings(small_mission("out"), 0).empty());
    }
}
