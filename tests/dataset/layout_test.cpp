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

/// The names of what a sensor leaves of each ping: folders, and files of records.
std::vector<std::string> per_ping(const SensorLayout& sensor) {
    std::vector<std::string> names;
    for (const auto& part : sensor.per_ping) {
        const auto* file = std::get_if<PingFile>(&part);
        names.push_back(file ? file->name : std::get<PingRecord>(part).file);
    }
    return names;
}

using Names = std::vector<std::string>;

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

    TEST_CASE("layout: output chooses the files") {
        Mission mission = small_mission("out");
        mission.output.polar = false;
        mission.output.fan = false;
        CHECK(per_ping(layout_of(mission, 1).sensors[1]) == Names{"image", "meta"});
    }

    TEST_CASE("layout: side-scan and echosounders have records and no image per ping") {
        const Mission mission = survey_mission("out");
        const Layout layout = layout_of(mission, 7);
        REQUIRE(layout.sensors.size() == 4);
        CHECK(per_ping(layout.sensors[0]) == Names{"polar", "image", "fan", "meta"});
        CHECK(per_ping(layout.sensors[1]) ==
              Names{"polar", "image", "fan", "soundings.npy", "meta"});
        CHECK(per_ping(layout.sensors[2]) == Names{"waterfall.npy", "meta"});
        CHECK(per_ping(layout.sensors[3]) == Names{"echogram.npy", "meta"});
        CHECK(layout.sensors[2].products == Names{"waterfall.png", "waterfall_view.png"});
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
