#include "input/mission/files.h"
#include "mission/fixtures.h"

namespace {

const std::string composed = R"(
scene:
  file: a.glb
  materials: a.csv
  material_default: rock
  units: mm
  up: z
  bottom: [floor]
  objects:
    - {name: wreck, class: ship, file: w.glb, position_m: [1, 2, 3], rpy_deg: [4, 5, 6], scale: 2,
       material: steel, place: on_bottom, bury_m: 0.5, align: true}
    - name: fish
      file: f.glb
      trajectory: {file: f.csv, rate_hz: 2}
  scatter:
    - {name: mine, files: [m.glb, n.glb], count: [1, 3], area_min_m: [0, 1], area_max_m: [2, 3],
       yaw_deg: 7, roll_deg: [-1, 1], scale: [0.5, 2], bury_m: 0.1, spacing_m: 0.3,
       class: target}
    - {name: tyre, files: t.glb, area_min_m: [0, 1], area_max_m: [2, 3]}
  particles:
    - {name: cod, class: cod, length_m: [0.3, 0.5], count: 7, region: ellipsoid,
       position_m: [1, 2, 3], size_m: [4, 5, 6], drift_m_s: [0.1, 0, 0]}
  water_surface: {height_m: 3, roughness: 0.2}
trajectory: {file: a.tum}
sensors: {fls: {kind: imaging, model: calibrated}}
variants: 3
vary:
  - {key: water.density_kg_m3, uniform: [990, 1030]}
  - {key: scene.objects.0.file, choice: [w.glb, "x y.glb"], per: dataset}
  - {key: sensors.fls.mount, choice: [{rpy_deg: [0, 10, 0]}, {translation_m: [1, 0, 0]}]}
)";

/// The smallest mission without its scene.
const std::string tail = smallest_mission.substr(smallest_mission.find('\n') + 1);

}  // namespace

TEST_CASE("the keys of a composed scene") {
    const Mission mission = parse(composed);
    const SceneConfig& scene = mission.scene;
    CHECK(scene.mesh.units == LengthUnit::mm);
    CHECK(scene.mesh.up == UpAxis::z);
    REQUIRE(scene.objects.size() == 2);
    CHECK(scene.objects[0].class_name == "ship");
    CHECK(scene.objects[0].place_on == ObjectPlace::on_bottom);
    CHECK(scene.objects[0].mesh.material == "steel");
    CHECK(std::get<FileTrajectoryConfig>(*scene.objects[1].trajectory).file == "/base/f.csv");
    REQUIRE(scene.scatter.size() == 2);
    CHECK(scene.scatter[0].count == std::array{1.0, 3.0});
    CHECK(scene.scatter[0].yaw_deg == std::array{7.0, 7.0});
    CHECK(scene.scatter[1].files == std::vector<std::filesystem::path>{"/base/t.glb"});
    CHECK(scene.scatter[1].yaw_deg == std::array{0.0, 360.0});
    REQUIRE(scene.particles.size() == 1);
    CHECK(scene.particles[0].kind() == ParticleKind::fish);
    CHECK(scene.particles[0].length_m == std::array{0.3, 0.5});
    CHECK(scene.particles[0].count == std::array{7.0, 7.0});
    CHECK(scene.water_surface->roughness == 0.2);
    CHECK(mission.vary[1].choice.items == std::vector<std::string>{"\"w.glb\"", "\"x y.glb\""});
    CHECK(files_of(mission) ==
          std::vector<std::filesystem::path>{"/base/a.glb", "/base/a.csv", "/base/w.glb",
                                             "/base/f.glb", "/base/f.csv", "/base/m.glb",
                                             "/base/n.glb", "/base/t.glb", "/base/a.tum"});
}

TEST_CASE("a composed scene is written as it is read, and goes to another machine") {
    const Mission mission = parse(composed);
    CHECK(reads_back(mission));
    const Mission elsewhere = parse_mission(resolved_yaml(portable(mission), sonar_keys()),
                                            "m.yaml", "/other/place", {}, sonar_keys());
    CHECK(elsewhere.scene.objects[1].file == "/other/place/f.glb");
    CHECK(elsewhere.scene.scatter[0].files[1] == "/other/place/n.glb");
    CHECK(mission_hash(elsewhere, sonar_keys()) == mission_hash(mission, sonar_keys()));
}

TEST_CASE("rules of scatter have the scene's area, stock its files, clutter its rule") {
    const std::string head =
        "scene:\n  materials: a.csv\n  seabed: {cell_m: 1}\n  area_min_m: [0, 1]\n  "
        "area_max_m: [10, 5]\n";
    const Mission mission = parse(
        head +
        "  scatter:\n    - {name: a, files: [m.glb, n.glb, o.glb, p.glb], stock: [can, net]}\n"
        "    - {name: b, files: m.glb, bury: [-0.2, 0.5], density_per_m2: [0.1, 0.26]}\n" +
        tail);
    REQUIRE(mission.scene.scatter.size() == 2);
    const ScatterConfig& kinds = mission.scene.scatter[0];
    CHECK(kinds.class_of(1) == "can");
    CHECK(kinds.class_of(2) == "net");
    CHECK(kinds.area_max_m == std::array{10.0, 5.0});
    CHECK(mission.scene.scatter[1].class_of(0) == "b");
    CHECK(mission.scene.scatter[1].count == std::array{4.0, 11.0});
    CHECK(reads_back(mission));
    const Mission cluttered = parse(head +
                                    "  clutter: {density_per_m2: 0.5, bury: 0.1, files: m.glb, "
                                    "stock: [can]}\n" +
                                    tail);
    REQUIRE(cluttered.scene.scatter.size() == 1);
    const ScatterConfig& clutter = cluttered.scene.scatter[0];
    CHECK((clutter.class_of(0) == "clutter" && clutter.overlap));
    CHECK(clutter.count == std::array{20.0, 20.0});
    CHECK(clutter.bury == std::array{0.1, 0.1});
    CHECK(clutter.scale == ClutterConfig().scale);
    CHECK(reads_back(cluttered));
}

TEST_CASE("clutter: by default no kind that a rule of scatter labels") {
    std::string files = "m.glb";  // as many for each of 15 or 16 kinds
    for (int k = 1; k < 240; ++k)
        files += ", m.glb";
    const std::string head = "scene:\n  materials: a.csv\n  seabed: {cell_m: 1, size_m: [9, 9]}\n";
    const std::string clutter = "  clutter: {density_per_m2: 0.5, files: [" + files + "]}\n";
    for (const std::string name : {"pipe", "clutter"}) {
        const Mission mission = parse(
            head + "  scatter: [{name: a, files: [m.glb, n.glb], stock: [pipe, can], class: " +
            name + "}]\n" + clutter + tail);
        const std::vector<std::string>& kinds = mission.scene.scatter.at(1).stock;
        CHECK(std::ranges::count(kinds, "pipe") == (name == "clutter" ? 1 : 0));
        CHECK(std::ranges::count(kinds, "rope") == 1);
    }
}

TEST_CASE("what is refused of stock, clutter and areas") {
    const std::string head = "scene:\n  materials: a.csv\n  seabed: {cell_m: 1}\n";
    const auto begins = [&](const std::string& text, const std::string& words) {
        CHECK_MESSAGE(refusal(head + text + tail).starts_with("m.yaml:" + words),
                      refusal(head + text + tail));
    };
    begins("  scatter: [{name: a, stock: [tire]}]\n",
           "4:31: the stock has no 'tire' (did you mean 'tyre'?)");
    const std::string several = fault_of([&] {
        parse(head + "  scatter: [{name: a, stock: [tire, can, nett]}]\n" + tail + "ph: 8\n");
    });
    for (const char* const words :
         {"4:31: the stock has no 'tire'", "4:42: the stock has no 'nett'", "unknown key 'ph'"})
        CHECK_MESSAGE(several.find(words) != std::string::npos, several);
    begins("  scatter: [{name: a, stock: []}]\n",
           "4:30: a rule of 'scatter' needs 'stock' or 'files'");
    begins("  scatter: [{name: a, files: a.glb}]\n", "4:13: 'a' needs an area: ");
    begins("  scatter: [{name: a}]\n", "4:13: a rule of 'scatter' needs 'stock' or 'files'");
    begins("  scatter: [{name: a, files: a.glb, area_min_m: [0, 0]}]\n",
           "4:49: an area needs both");
    begins("  clutter: 3\n", "4:12: 'clutter' must be a section");
    begins("  clutter: {stock: [net]}\n", "4:12: 'clutter' needs the key 'density_per_m2'");
    begins("  area_min_m: [0, 0]\n  area_max_m: [0, 1]\n", "5:15: area_min_m must be below");
}
