#include "mission/fixtures.h"

namespace {

std::string set_refusal(const std::string& setting) {
    return refusal(smallest_mission, {setting});
}

}  // namespace

TEST_CASE("an override replaces a key or adds one, the last one winning") {
    const std::string text = smallest_mission + "    every: 5\nseed: 1\n";
    const Mission mission =
        parse(text, {"seed=7", "sensors.fls.every=2", "sensors.fls.noise.add_sigma=0.2",
                     "sensors.fls.mount.translation_m=[1, 2, 3]", "output.fan=false",
                     "scene.file=../other.glb", "seed=8"});
    CHECK(mission.seed == 8);
    CHECK(mission.sensors[0].every == 2);
    CHECK(mission.sensors[0].noise.add_sigma == 0.2);
    CHECK(mission.sensors[0].mount.translation_m == std::array{1.0, 2.0, 3.0});
    CHECK(!mission.output.fan);
    CHECK(mission.scene.file == "/other.glb");  // from the mission's folder, as in the file
    CHECK(mission.water.density_kg_m3 == WaterConfig{}.density_kg_m3);
}

TEST_CASE("an override reaches into lists and replaces whole sections") {
    const Mission mission =
        parse(smallest_mission,
              {"trajectory={waypoints: [{position_m: [0, 0, 0]}, {position_m: [1, 0, 0]}]}",
               "trajectory.waypoints.1.position_m.2=-4", "trajectory.speed_m_s=2",
               "sensors.aft={kind: imaging, every: 3}", "water={density_kg_m3: 1025}",
               "scene.sediment_map={file: m.png, materials: {1: mud, 3: mud}}",
               "scene.sediment_map.materials.3=sand"});
    const auto& waypoints = std::get<WaypointTrajectoryConfig>(mission.trajectory);
    CHECK(waypoints.waypoints.at(1).position_m == std::array{1.0, 0.0, -4.0});
    CHECK(waypoints.speed_m_s == 2.0);
    REQUIRE(mission.sensors.size() == 2);
    CHECK(mission.sensors[1].name == "aft");
    CHECK(mission.sensors[1].every == 3);
    CHECK(mission.water.density_kg_m3 == 1025.0);
    CHECK(mission.scene.sediment_map->materials == Renaming{{"1", "mud"}, {"3", "sand"}});
}

TEST_CASE("an override is checked like the file and named in the message") {
    for (const auto& [setting, message] : std::vector<std::pair<std::string, std::string>>{
             {"sensors.fls.noise.add_sigm=0.2",
              "unknown key 'add_sigm' (did you mean 'add_sigma'?)"},
             {"sensors.fsl.noise.add_sigma=0.2", "there is no 'fsl' in 'sensors'; there are: fls"},
             {"sensors.flss.every=2", "there is no 'flss' in 'sensors' (did you mean 'fls'?)"},
             {"seed=", "'seed' must be a whole number from 0 to 2^64 - 1, not nothing"},
             {"sensors.fls.range_max_m=0.05",
              "range_min_m must be below range_max_m (range_min_m is 0.1, range_max_m is 0.05)"},
             {"water={density_kg_m3: 1, density_kg_m3: 2}", "duplicate key 'density_kg_m3'"},
             {"seed.x=5",
              "'seed' must be a whole number from 0 to 2^64 - 1, not a section of keys"},
             {"scene.file.x=5", "there is no key 'x' below the single value 'a.glb'"},
             {"name=&a b", "anchors (&name) are not supported; write the value out"}})
        CHECK(set_refusal(setting) == "--set " + setting + ": " + message);
    // An unknown key of the file stays the file's.
    CHECK(refusal(smallest_mission + "sead: 1\n", {"sead=2"}) ==
          "m.yaml:6:1: unknown key 'sead' (did you mean 'seed'?)");
}

TEST_CASE("an override that cannot be read") {
    const std::string usage = ": write --set key=value or --set section.key=value";
    for (const char* setting : {"seed", "", "=5", ".seed=5", "seed.=5", "a..b=5",
                                "a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q=1"}) {
        CHECK(set_refusal(setting) == "--set " + std::string(setting) + usage);
    }
    CHECK(set_refusal("name=run #3").ends_with("begins a comment of YAML, needs quotes"));
    CHECK(set_refusal("seed=]").starts_with("--set seed=]: not valid YAML: "));
    CHECK(set_refusal("name=\xff").ends_with(": is not UTF-8 text; save the file as UTF-8"));
    const std::string list = smallest_mission + "    mount: {rpy_deg: [1, 2, 3]}\n";
    CHECK(refusal(list, {"sensors.fls.mount.rpy_deg.3=1"}) ==
          "--set sensors.fls.mount.rpy_deg.3=1: no item '3'; the list has 3, counted from 0");
    CHECK(refusal(list, {"sensors.fls.mount.rpy_deg.x=1"}) ==
          "--set sensors.fls.mount.rpy_deg.x=1: no item 'x'; the list has 3, counted from 0");
    CHECK(parse(list, {"sensors.fls.mount.rpy_deg.0=9"}).sensors[0].mount.rpy_deg[0] == 9.0);
    CHECK(set_refusal("name=" + std::string(5000, '/')).size() < 300);
}
