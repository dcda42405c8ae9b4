#include "run/report/report.h"
#include "support/small_mission.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// Two sonars; only the first has multipath.
Mission corner_mission(const MultipathConfig& multipath) {
    Mission mission = small_mission("unused");
    mission.sensors[0].multipath = multipath;
    return mission;
}

/// A corner of two walls in front of the vehicle, which moves towards them.
Assembly corner_assembly(const Mission& mission) {
    Assembly assembly = small_assembly(mission, 3);
    Scene scene = empty_scene();
    const std::uint32_t m = add_material(scene, 0.6F);
    add_quad(scene, {0, 0, 0}, {-6, 6, 0}, {-6, 6, 3}, {0, 0, 3}, m);
    add_quad(scene, {0, 0, 0}, {-6, -6, 0}, {-6, -6, 3}, {0, 0, 3}, m);
    assembly.scene = scene;
    return assembly;
}

std::vector<MultipathRow> measure(const Mission& mission, const Assembly& assembly) {
    ReportOptions options;
    options.poses = 2;
    options.rounds = 1;
    return measure_multipath(mission, assembly, options, [](const std::string&) {});
}

const MultipathRow& row_of(const std::vector<MultipathRow>& rows, int epsilon, double delta) {
    const auto at = std::ranges::find_if(rows, [&](const MultipathRow& row) {
        return row.setting.epsilon_bins == epsilon && row.setting.delta_deg == delta;
    });
    REQUIRE(at != rows.end());
    return *at;
}

}  // namespace

TEST_SUITE_BEGIN("benchmark");

TEST_CASE("multipath rows of a corner are sane, for each sonar that has multipath") {
    const Mission mission = corner_mission({MultipathMethod::cluster, 5, 5.0});
    const std::vector<MultipathRow> rows = measure(mission, corner_assembly(mission));
    REQUIRE(rows.size() == 13);  // exact, 4 x 3 clusters
    for (const MultipathRow& row : rows) {
        CAPTURE(row.setting.epsilon_bins);
        CAPTURE(row.setting.delta_deg);
        CHECK(row.sensor == "front");
        CHECK(row.exact_bins > 20);
        // On two planes every cluster is exact up to rounding at the edges of bins.
        CHECK(row.relative_l1 < 0.02);
        CHECK(row.recall > 0.98);
        CHECK(row.precision > 0.98);
        CHECK(row.ms_multipath > 0.0);
        CHECK(row.ms_multipath < row.ms_per_ping);
        CHECK(row.times_without > 0.0);
    }
    CHECK(rows[0].setting.method == MultipathMethod::exact);
    CHECK(rows[0].relative_l1 == 0.0);
    CHECK(rows[0].recall == 1.0);
    CHECK(rows[0].precision == 1.0);
    CHECK(std::ranges::count(rows, true, &MultipathRow::current) == 1);
    CHECK(row_of(rows, 5, 5.0).current);
    const Mission without = small_mission("unused");
    CHECK(measure(without, small_assembly(without, 2)).empty());
}

TEST_CASE("multipath rows tell a coarse way from a fine one") {
    Mission mission = corner_mission({MultipathMethod::cluster, 1, 5.0});
    // The tank has a pole and a sphere, whose normals vary. Coarse bins would hold the whole sphere
    // and hide the difference.
    mission.sensors[0].range_bins = 192;
    const std::vector<MultipathRow> rows = measure(mission, small_assembly(mission, 3));
    const MultipathRow& fine = row_of(rows, 1, 5.0);
    const MultipathRow& coarse = row_of(rows, 9, 30.0);
    CHECK(fine.relative_l1 < coarse.relative_l1);
    CHECK(coarse.recall < 1.0);
    CHECK(fine.recall > 0.9);
}

TEST_CASE("the settings of multipath hold the mission's own way once") {
    CHECK(multipath_settings({MultipathMethod::cluster, 5, 15.0}).size() == 13);
    CHECK(multipath_settings({MultipathMethod::cluster, 4, 15.0}).size() == 14);
    // The exact method ignores epsilon and delta.
    CHECK(multipath_settings({MultipathMethod::exact, 5, 5.0}).size() == 13);
    const Mission mission = corner_mission({MultipathMethod::exact, 5, 5.0});
    const std::vector<MultipathRow> rows = measure(mission, corner_assembly(mission));
    CHECK(std::ranges::count(rows, true, &MultipathRow::current) == 1);
    CHECK(rows[0].current);
}

TEST_SUITE_END();
