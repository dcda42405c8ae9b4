#include "benchmark/report.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "core/units.h"
#include "support/approx.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "support/small_mission.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// A report on one small sonar with two settings of rays and one of the octree.
Report small_report() {
    Mission mission = small_mission("unused");
    mission.sensors.resize(1);
    const Assembly assembly = small_assembly(mission, 4);
    const std::vector<Setting> settings{
        {"rays", "relative_l1=0.3", EngineKind::rays, {}, 0.3, false},
        {"rays", "relative_l1=0.01", EngineKind::rays, {}, 0.01, true},
        {"octree", "leaf_m=0.04", EngineKind::octree, {0.04}, 0.03, false}};
    ReportOptions options;
    options.poses = 2;
    options.rounds = 1;
    options.threads = 2;
    options.reference_moved = 0.005;
    options.reference_rays = 20'000'000;
    return make_report(mission, assembly, settings, options, [](const std::string&) {});
}

/// The error of rays with a fine goal, and of the reference, on the first sonar of a mission.
Report report_of_rays(const Mission& mission, const Assembly& assembly) {
    const std::vector<Setting> settings{
        {"rays", "relative_l1=0.01", EngineKind::rays, {}, 0.01, true}};
    ReportOptions options;
    options.poses = 3;
    options.rounds = 1;
    options.threads = 2;
    options.reference_moved = 0.005;
    options.reference_rays = 4'000'000;
    return make_report(mission, assembly, settings, options, [](const std::string&) {});
}

/// A row with the figures that the choice depends on.
ReportRow row_of(const std::string& engine, const std::string& name, double ms, double l1) {
    ReportRow row;
    row.sensor = "fls";
    row.setting.engine = engine;
    row.setting.name = name;
    row.ms_per_ping = ms;
    row.relative_l1 = l1;
    row.worst_relative_l1 = l1;
    return row;
}

}  // namespace

TEST_SUITE_BEGIN("benchmark");

TEST_CASE("a report has a sane row per setting, as Markdown and JSON" *
          doctest::skip(test::sanitized)) {
    const Report report = small_report();
    REQUIRE(report.rows.size() == 3);
    CHECK(report.poses == 2);
    for (const ReportRow& row : report.rows) {
        CAPTURE(row.setting.engine);
        CHECK(row.sensor == "front");
        CHECK(row.ms_per_ping > 0.0);
        CHECK(row.pings_per_s > 0.0);
        CHECK(row.samples_per_ping > 0.0);
        // The octree alone misses bins.
        const bool literal = row.setting.engine == "octree";
        CHECK(row.worst_relative_l1 < (literal ? 0.3 : 0.1));
        CHECK(row.miss_rate < 0.1);
        CHECK(row.ms_rays > 0.0);
        CHECK(row.times_rays > 0.0);
    }
    // A finer goal takes more samples. Both errors are below the finer goal: with few beams the
    // objects of the tank are fine surface.
    CHECK(report.rows[1].samples_per_ping > report.rows[0].samples_per_ping);
    CHECK(report.rows[0].relative_l1 < 0.01);
    CHECK(report.rows[1].relative_l1 < 0.01);
    REQUIRE(report.references.size() == 1);
    CHECK(report.references[0].max_moved < 0.05);

    const auto json = nlohmann::json::parse(report_json(report));
    REQUIRE(json["rows"].size() == 3);
    const std::set<std::string> keys{
        "sensor",      "engine",      "setting",          "current",          "goal",
        "on_front",    "ms_per_ping", "pings_per_s",      "ms_131k_rays",     "times_131k_rays",
        "relative_l1", "miss_rate",   "samples_per_ping", "worst_relative_l1"};
    for (const auto& row : json["rows"]) {
        std::set<std::string> found;
        for (const auto& [key, value] : row.items())
            found.insert(key);
        CHECK(found == keys);
    }
    CHECK(json["reference"][0]["sensor"] == "front");
    CHECK(json["reference"][0]["moved_mean"].get<double>() > 0.0);

    CHECK(report_markdown(report).find("| rays | relative_l1=0.01 |") != std::string::npos);
}

TEST_CASE("a report on shared copies is one on their triangles" * doctest::skip(test::sanitized)) {
    Mission mission = small_mission("unused");
    mission.sensors.resize(1);
    Assembly copied = small_assembly(mission, 4);
    Assembly shared = copied;
    Scene& scene = shared.scene;
    // So large that the rays resolve it: copies are never fine surface.
    Scene crate = empty_scene();
    add_sphere(crate, {0, 0, 0}, 0.45F, 0, 16);
    scene.shared_meshes.push_back({crate.vertices, crate.triangles, crate.triangle_material});
    for (const Eigen::Vector3d& at : {Eigen::Vector3d(-1, 0.5, 1.5), Eigen::Vector3d(0, -1, 1.4)}) {
        Eigen::Affine3d T_world_mesh = Eigen::Affine3d::Identity();
        T_world_mesh.translation() = at;
        scene.copies.push_back({0, 0, T_world_mesh});
        const Eigen::Vector3d middle = at - copied.scene.origin;
        add_sphere(copied.scene, middle.cast<float>(), 0.45F, 0, 16);
    }
    const Report a = report_of_rays(mission, shared);
    const Report b = report_of_rays(mission, copied);
    CHECK(a.triangles == b.triangles);
    CHECK(a.references[0].rays_per_bin / b.references[0].rays_per_bin ==
          test::approx(1.0).epsilon(1e-3));
    REQUIRE(a.rows.size() == 1);
    const ReportRow& of_copies = a.rows[0];
    const ReportRow& of_triangles = b.rows[0];
    CHECK(of_copies.worst_relative_l1 < 0.02);
    CHECK(of_copies.worst_relative_l1 / of_triangles.worst_relative_l1 ==
          test::approx(1.0).epsilon(0.02));
    CHECK(of_copies.samples_per_ping / of_triangles.samples_per_ping ==
          test::approx(1.0).epsilon(1e-3));
    // Only rays can trace it, which `auto` then takes.
    for (const Setting& setting : make_settings(mission, false)) {
        CAPTURE(setting.engine);
        CHECK(unsupported(setting, copied).empty());
        CHECK(unsupported(setting, shared).empty() ==
              (setting.kind == EngineKind::rays || setting.kind == EngineKind::automatic));
    }
}

TEST_CASE("a report pings as the mission does: with the draws of each ping, and a turning head" *
          doctest::skip(test::sanitized)) {
    Mission mission = small_mission("unused");
    mission.sensors.resize(1);
    const Assembly assembly = small_assembly(mission, 4);
    const ReportRow still = report_of_rays(mission, assembly).rows[0];
    SUBCASE("draws") {
        VaryConfig rule;
        rule.key = "sensors.front.mount.rpy_deg.2";
        rule.per = VaryPer::ping;
        rule.uniform = {20.0, 70.0};
        mission.vary.push_back(rule);
        const ReportRow row = report_of_rays(mission, assembly).rows[0];
        // If it looked in another direction than its reference, nearly every bin would be wrong.
        CHECK(row.worst_relative_l1 < 0.05);
        CHECK(row.worst_relative_l1 != still.worst_relative_l1);
    }
    SUBCASE("head") {
        mission.sensors[0].kind = SonarKind::scanning;
        mission.sensors[0].azimuth_bins = 1;
        mission.sensors[0].azimuth_deg = 2.0;
        mission.sensors[0].sector_deg = 180.0;
        mission.sensors[0].step_deg = 30.0;
        const Assembly turning = small_assembly(mission, 4);
        REQUIRE(turning.sonars[0].head_angles_rad.size() > 3);
        CHECK(report_of_rays(mission, turning).rows[0].worst_relative_l1 < 0.02);
    }
    SUBCASE("the calibrated model") {
        // Compared with the calibrated reference; compared with the paper's, its levels would be
        // far off.
        mission.sensors[0].model = ModelKind::calibrated;
        mission.sensors[0].instrument.frequency_hz = 9e5;
        const ReportRow row = report_of_rays(mission, small_assembly(mission, 4)).rows[0];
        CHECK(row.worst_relative_l1 < 0.1);
    }
}

TEST_CASE("the settings holds the mission's own setting once, marked, and no needless leaves") {
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
    mission.octree.leaf_m = 0.03;
    CHECK(marked(make_settings(mission, true)) == std::vector<std::string>{"octree leaf_m=0.03"});
    // Bins of 9.9 m / 48 = 20.6 cm: leaves below 5.2 cm are left out.
    for (const Setting& setting : make_settings(mission, false)) {
        CHECK(setting.name != "leaf_m=0.04");
        CHECK(setting.name != "leaf_m=0.01");
    }
}

TEST_CASE("a goal is met at the worst pose, or missed") {
    ReportRow row = row_of("rays", "relative_l1=0.03", 1.0, 0.02);
    row.setting.relative_l1 = 0.03;
    CHECK(std::string(row.goal()) == "met");
    row.worst_relative_l1 = 0.031;
    CHECK(std::string(row.goal()) == "missed");
    row.setting.kind = EngineKind::slices;
    CHECK(std::string(row.goal()) == "missed");
    row.setting.kind = EngineKind::octree;
    CHECK(std::string(row.goal()) == "-");
}

TEST_CASE("the yardstick rays are spread evenly over the view") {
    View view{radians(60.0), radians(12.0), 0.5, 10.0, 100, 1, 0.03};
    SUBCASE("fan") {}
    SUBCASE("sides") {
        view.shape = ViewShape::port_starboard;
        view.beams = 2;
    }
    SUBCASE("cone") {
        view.shape = ViewShape::cone;
        view.elevation_rad = view.azimuth_rad;
    }
    const std::vector<Eigen::Vector3f> rays = view_rays(view);
    CHECK(rays.size() == view_rays_count);
    CHECK(std::ranges::all_of(rays, [&](const Eigen::Vector3f& d) {
        return std::fabs(d.norm() - 1.0F) < 1e-6F && beam_of(view, d) >= 0;
    }));
    CHECK(std::ranges::count_if(rays, [](const Eigen::Vector3f& d) { return d.y() > 0.0F; }) ==
          view_rays_count / 2);
}

TEST_CASE("poses are spread from end to end") {
    CHECK(sample_poses(10, 4) == std::vector<std::size_t>{0, 3, 6, 9});
    CHECK(sample_poses(2, 8) == std::vector<std::size_t>{0, 1});
    CHECK(sample_poses(5, 1) == std::vector<std::size_t>{0});
}

TEST_CASE("summaries by hand") {
    CHECK(median_of({4.0, 1.0, 2.0, 3.0}) == 2.5);
    CHECK(mean_of({1.0, 2.0, 6.0}) == test::approx(3.0));
}

TEST_SUITE_END();
