#include "dataset/layout.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "core/file.h"
#include "support/small_mission.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using sonarsim::test::small_mission;
using sonarsim::test::survey_mission;
using sonarsim::test::TemporaryFolder;

TEST_SUITE("dataset") {
    TEST_CASE("layout: files bear the pose's index in six digits, or as many as it takes") {
        const Mission mission = small_mission("out");
        const Layout layout = make_layout(mission, 1'000'000);
        CHECK(layout.file({7, 0}, FileKind::polar) == "out/front/polar/000007.npy");
        CHECK(layout.file({7, 0}, FileKind::image) == "out/front/image/000007.png");
        CHECK(layout.file({7, 1}, FileKind::fan) == "out/left/fan/000007.png");
        CHECK(layout.file({999'999, 1}, FileKind::meta) == "out/left/meta/999999.json");
        CHECK(make_layout(mission, 1'000'001).number(7) == "0000007");
        CHECK(make_layout(mission, 0).number(0) == "000000");
    }

    TEST_CASE("layout: output chooses the files, and there must be some") {
        Mission mission = small_mission("out");
        mission.output.polar = mission.output.fan = false;
        CHECK(make_layout(mission, 1).sensors[1].kinds ==
              std::vector{FileKind::image, FileKind::meta});
        mission.output.image = mission.output.meta = false;
        CHECK_THROWS_WITH_AS(make_layout(mission, 1),
                             "mission 'small' writes nothing of sensor 'front': set one of "
                             "output.polar, image, fan, stages or meta to true",
                             InputError);
    }

    TEST_CASE("layout: side-scan and echosounders have metadata per ping and no image") {
        Mission mission = survey_mission("out");
        const Layout layout = make_layout(mission, 7);
        REQUIRE(layout.sensors.size() == 4);
        CHECK(layout.sensors[0].series.record.empty());
        CHECK(layout.sensors[1].kinds ==
              std::vector{FileKind::polar, FileKind::image, FileKind::fan, FileKind::meta});
        CHECK(layout.sensors[2].kinds == std::vector{FileKind::meta});
        CHECK(layout.sensors[3].kinds == std::vector{FileKind::meta});
        CHECK(layout.series_file(1, layout.sensors[1].series.record) == "out/mbes/soundings.npy");
        CHECK(layout.series_file(2, layout.sensors[2].series.record) == "out/sss/waterfall.npy");
        CHECK(layout.series_file(3, layout.sensors[3].series.record) == "out/sounder/echogram.npy");
        // The sounder pings at poses 0, 2, 4 and 6.
        CHECK(layout.sensors[3].pings == 4);
        CHECK(layout.record_of({6, 3}) == 3);
        // Without its meta file nothing would say that a ping is done.
        mission.output.meta = false;
        CHECK(make_layout(mission, 7).sensors[2].kinds == std::vector{FileKind::meta});
        mission.output.waterfall = false;
        CHECK_THROWS_WITH_AS(make_layout(mission, 7),
                             "mission 'survey' writes nothing of sensor 'sss': set one of "
                             "output.meta, waterfall or echogram to true",
                             InputError);
        mission.output.meta = true;
        CHECK(make_layout(mission, 7).sensors[2].series.record.empty());
    }

    TEST_CASE("layout: a sensor with `every: 3` pings at poses 0, 3, 6, ...") {
        const std::vector<PingId> expected{{0, 0}, {0, 1}, {1, 0}, {2, 0}, {3, 0}, {3, 1}};
        CHECK(list_pings(small_mission("out"), 4) == expected);
        CHECK(list_pings(small_mission("out"), 0).empty());
    }

    TEST_CASE("layout: a ping is there when all of its files are") {
        const TemporaryFolder folder;
        Mission mission = small_mission(folder.path);
        mission.output.image = mission.output.fan = false;
        const Layout layout = make_layout(mission, 10);
        std::filesystem::create_directories(layout.kind_folder(0, FileKind::polar));
        std::filesystem::create_directories(layout.kind_folder(0, FileKind::meta));
        CHECK_FALSE(layout.has({3, 0}));
        write_file(layout.file({3, 0}, FileKind::polar), "x");
        CHECK_FALSE(layout.has({3, 0}));
        write_file(layout.file({3, 0}, FileKind::meta), "x");
        CHECK(layout.has({3, 0}));
        CHECK_FALSE(layout.has({4, 0}));
        CHECK_FALSE(layout.has({3, 1}));
    }
}
