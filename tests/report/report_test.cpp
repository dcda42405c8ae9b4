#include "run/report/report.h"

#include "support/small_mission.h"

namespace {

/// Throws if the row has no such number: in JSON's order null is below all numbers.
double number_of(const Json& row, const char* key) {
    return row.at(key).get<double>();
}

/// A report on the first sonar of a mission, whose poses are those of small_assembly().
Json report_of(const Mission& mission, const std::vector<Setting>& settings) {
    const ReportOptions options{.poses = 3,
                                .rounds = 1,
                                .threads = 2,
                                .reference_noise = 0.005,
                                .reference_rays = 4'000'000};
    return make_report(mission, small_assembly(mission, 4), settings, options,
                       [](const std::string&) {});
}

/// The error of rays with a fine goal.
double error_of_rays(const Mission& mission) {
    const Setting fine{"rays", "relative_l1=0.01", EngineKind::rays, {}, 0.01, true};
    return report_of(mission, {fine})["rows"][0]["worst_relative_l1"];
}

/// Two sonars; only the first has multipath.
Mission corner_mission(const MultipathConfig& multipath) {
    Mission mission = small_mission("unused");
    mission.sensors[0].multipath = multipath;
    return mission;
}

/// A corner of two walls in front of the vehicle, which moves towards them.
Assembly corner_assembly(const Mission& mission) {
    Assembly assembly = small_assembly(mission, 3);
    assembly.scene = empty_scene();
    const std::uint32_t m = add_material(assembly.scene, 0.6F);
    add_quad(assembly.scene, {0, 0, 0}, {-6, 6, 0}, {-6, 6, 3}, {0, 0, 3}, m);
    add_quad(assembly.scene, {0, 0, 0}, {-6, -6, 0}, {-6, -6, 3}, {0, 0, 3}, m);
    return assembly;
}

std::vector<Json> measure(const Mission& mission, const Assembly& assembly) {
    return measure_multipath(mission, assembly, {.poses = 2, .rounds = 1},
                             [](const std::string&) {});
}

const Json& row_of(const std::vector<Json>& rows, int epsilon, double delta) {
    const auto at = std::ranges::find_if(rows, [&](const Json& row) {
        return row["epsilon_bins"] == epsilon && row["delta_deg"] == delta;
    });
    REQUIRE(at != rows.end());
    return *at;
}

std::ptrdiff_t count_current(const std::vector<Json>& rows) {
    return std::ranges::count_if(rows, [](const Json& row) { return row["current"] == true; });
}

}  // namespace

TEST_CASE("a report has a sane row per setting") {
    Mission mission = small_mission("unused");
    mission.sensors.resize(1);
    const Json report =
        report_of(mission, {{"strips", "relative_l1=0.3", EngineKind::strips, 0.02, 0.3, false},
                            {"strips", "relative_l1=0.01", EngineKind::strips, 0.02, 0.01, true},
                            {"octree", "leaf_m=0.04", EngineKind::octree, 0.04, 0.03, false}});
    REQUIRE(report["rows"].size() == 3);
    CHECK(report["poses"] == 3);
    for (const Json& row : report["rows"]) {
        CAPTURE(row["engine"]);
        CHECK(row["sensor"] == "front");
        for (const char* key : {"ms_per_ping", "pings_per_s", "ms_131k_rays", "times_131k_rays"})
            CHECK(number_of(row, key) > 0.0);
        // The octree alone misses bins.
        CHECK(number_of(row, "worst_relative_l1") < (row["engine"] == "octree" ? 0.3 : 0.1));
        CHECK(number_of(row, "miss_rate") < 0.1);
    }
    // A finer goal takes more samples.
    CHECK(number_of(report["rows"][1], "samples_per_ping") >
          number_of(report["rows"][0], "samples_per_ping"));
    CHECK(report["rows"][0]["goal"] == "met");
    CHECK(report["rows"][2]["goal"] == "-");
    CHECK(number_of(report["rows"][0], "relative_l1") < 0.01);
    CHECK(number_of(report["rows"][1], "relative_l1") < 0.01);
    REQUIRE(report["reference"].size() == 1);
    CHECK(number_of(report["reference"][0], "noise_max") < 0.05);
}

TEST_CASE("a report pings as the mission does: with the draws of each ping, and a turning head") {
    Mission mission = small_mission("unused");
    mission.sensors.resize(1);
    SUBCASE("draws") {
        const double still = error_of_rays(mission);
        VaryConfig rule;
        rule.key = "sensors.front.mount.rpy_deg.2";
        rule.per = VaryPer::ping;
        rule.uniform = {20.0, 70.0};
        mission.vary.push_back(rule);
        const double drawn = error_of_rays(mission);
        // If it looked in another direction than its reference, nearly every bin would be wrong.
        CHECK(drawn < 0.05);
        CHECK(drawn != still);
    }
    SUBCASE("head") {
        mission.sensors[0].kind = SonarKind::scanning;
        mission.sensors[0].azimuth_bins = 1;
        mission.sensors[0].azimuth_deg = 2.0;
        mission.sensors[0].sector_deg = 180.0;
        mission.sensors[0].step_deg = 30.0;
        CHECK(error_of_rays(mission) < 0.02);
    }
    SUBCASE("the calibrated model") {
        // Compared with the paper's reference, its levels would be far off.
        mission.sensors[0].model = ModelKind::calibrated;
        mission.sensors[0].instrument.frequency_hz = 9e5;
        CHECK(error_of_rays(mission) < 0.1);
    }
}

TEST_CASE("the settings hold the mission's own setting once, marked, and no needless leaves") {
    Mission mission = small_mission("unused");
    const auto marked = [](const std::vector<Setting>& settings) {
        std::vector<std::string> out;
        for (const Setting& setting : settings) {
            if (setting.current) out.push_back(setting.engine + " " + setting.name);
        }
        return out;
    };
    CHECK(marked(make_settings(mission, false)) ==
          std::vector<std::string>{"auto relative_l1=0.03"});
    mission.accuracy.relative_l1 = 0.05;
    CHECK(marked(make_settings(mission, true)) ==
          std::vector<std::string>{"auto relative_l1=0.05"});
    mission.engine = EngineKind::octree;
    mission.octree_leaf_m = 0.03;
    CHECK(marked(make_settings(mission, true)) == std::vector<std::string>{"octree leaf_m=0.03"});
    // Bins of 9.9 m / 48 = 20.6 cm: leaves below 5.2 cm are left out.
    for (const Setting& setting : make_settings(mission, false)) {
        CHECK(setting.name != "leaf_m=0.04");
        CHECK(setting.name != "leaf_m=0.01");
    }
    // The octree does not know of copies.
    Assembly assembly = small_assembly(mission, 1);
    assembly.scene.shared_meshes.push_back({});
    assembly.scene.copies.push_back({0, 0, Eigen::Affine3d::Identity()});
    for (const Setting& setting : make_settings(mission, false))
        CHECK(unsupported(setting, assembly).empty() == (setting.kind != EngineKind::octree));
}

TEST_CASE("the yardstick rays are spread evenly over the view") {
    for (const ViewShape shape : {ViewShape::fan, ViewShape::port_starboard, ViewShape::cone}) {
        const View view =
            with_shape({radians(60.0), radians(12.0), 0.5, 10.0, 100, 1, 0.03}, shape);
        const std::vector<Eigen::Vector3f> rays = view_rays(view);
        CAPTURE(static_cast<int>(shape));
        CHECK(rays.size() == view_rays_count);
        CHECK(std::ranges::all_of(rays, [&](const Eigen::Vector3f& d) {
            return std::fabs(d.norm() - 1.0F) < 1e-6F && beam_of(view, d) >= 0;
        }));
        CHECK(std::ranges::count_if(rays, [](const Eigen::Vector3f& d) { return d.y() > 0.0F; }) ==
              view_rays_count / 2);
    }
}

TEST_CASE("multipath rows of a corner are sane, for each sonar that has multipath") {
    const Mission mission = corner_mission({MultipathMethod::cluster, 5, 5.0});
    const std::vector<Json> rows = measure(mission, corner_assembly(mission));
    REQUIRE(rows.size() == 13);  // exact, 4 x 3 clusters
    for (const Json& row : rows) {
        CAPTURE_ALL(row["epsilon_bins"], row["delta_deg"]);
        CHECK(row["sensor"] == "front");
        CHECK(number_of(row, "exact_bins") > 20);
        // On two planes every cluster is exact up to rounding at the edges of bins.
        CHECK(number_of(row, "relative_l1") < 0.02);
        CHECK(number_of(row, "recall") > 0.98);
        CHECK(number_of(row, "precision") > 0.98);
        CHECK(number_of(row, "ms_multipath") > 0.0);
        CHECK(number_of(row, "ms_multipath") < number_of(row, "ms_per_ping"));
        CHECK(number_of(row, "times_without") > 0.0);
    }
    CHECK(rows[0]["method"] == "exact");
    CHECK(rows[0]["relative_l1"] == 0.0);
    CHECK(rows[0]["recall"] == 1.0);
    CHECK(rows[0]["precision"] == 1.0);
    CHECK(count_current(rows) == 1);
    CHECK(row_of(rows, 5, 5.0)["current"] == true);
    const Mission without = small_mission("unused");
    CHECK(measure(without, small_assembly(without, 2)).empty());
}

TEST_CASE("multipath rows tell a coarse way from a fine one") {
    Mission mission = corner_mission({MultipathMethod::cluster, 1, 5.0});
    // The tank has a pole and a sphere, whose normals vary. Coarse bins would hide that.
    mission.sensors[0].range_bins = 192;
    const std::vector<Json> rows = measure(mission, small_assembly(mission, 3));
    const Json& fine = row_of(rows, 1, 5.0);
    const Json& coarse = row_of(rows, 9, 30.0);
    CHECK(number_of(fine, "relative_l1") < number_of(coarse, "relative_l1"));
    CHECK(number_of(coarse, "recall") < 1.0);
    CHECK(number_of(fine, "recall") > 0.9);
}

TEST_CASE("the settings of multipath hold the mission's own way once") {
    CHECK(multipath_settings({MultipathMethod::cluster, 5, 15.0}).size() == 13);
    CHECK(multipath_settings({MultipathMethod::cluster, 4, 15.0}).size() == 14);
    // The exact method ignores epsilon and delta.
    CHECK(multipath_settings({MultipathMethod::exact, 5, 5.0}).size() == 13);
    const Mission mission = corner_mission({MultipathMethod::exact, 5, 5.0});
    const std::vector<Json> rows = measure(mission, corner_assembly(mission));
    CHECK(count_current(rows) == 1);
    CHECK(rows[0]["current"] == true);
}
