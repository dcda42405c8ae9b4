#include "input/scene/materials.h"

#include "support/test.h"

namespace {

const std::string header = "material,density_kg_m3,sound_speed_m_s\n";

}  // namespace

TEST_CASE("materials: HoloOcean's header, byte order mark, CRLF, comments, optional columns") {
    const MaterialTable table = parse_materials(
        "\xEF\xBB\xBF"
        "Material, Density kg/m^3, Speed of Sound m/s, volume_parameter, loss_parameter, "
        "spectral_exponent, spectral_strength_cm4\r\n# note\r\n\r\n"
        "silt, 1700, 1575, 0.001, 0.004, 3.3, 5e-4\r\n",
        "m.csv");
    REQUIRE(table.materials.size() == 1);
    const Material& silt = table.materials[0];
    CHECK(silt.name == "silt");
    CHECK(silt.sound_speed_m_s == 1575.0);
    CHECK(silt.volume_parameter == 0.001);
    CHECK(silt.loss_parameter == 0.004);
    CHECK(silt.spectral_exponent == 3.3);
    CHECK(silt.spectral_strength_cm4 == 5e-4);
    const MaterialTable others = parse_materials(
        "material,density_kg_m3,sound_speed_m_s,roughness_m,grain_phi,slope_rms_deg,lambert_"
        "db,wall_mm\n"
        "sand,1900,1650,,1.5,,,\nplate,7850,5890,1e-6,,0,-300,1.2\n",
        "m.csv");
    const Material& sand = others.materials[0];
    CHECK(sand.grain_phi == 1.5);
    CHECK(sand.lambert_db == Material{}.lambert_db);
    CHECK(sand.slope_rms_deg == Material{}.slope_rms_deg);
    const Material& plate = others.materials[1];
    CHECK(!plate.grain_phi);
    CHECK(plate.slope_rms_deg == 0.0);
    CHECK(plate.lambert_db == -300.0);
    CHECK(plate.wall_mm == 1.2);
    CHECK(!sand.wall_mm);
}

TEST_CASE("materials: errors name file and line") {
    const std::string optional = "material,density_kg_m3,sound_speed_m_s,";
    const std::pair<std::string, std::string> faulty[] = {
        {optional + "grain_fi\nsand,1900,1650,1.5\n",
         "1: unknown column 'grain_fi' (did you mean 'grain_phi'?); docs/scenes.md lists them"},
        {optional + "grain_phi,lambert_db,grain_phi\nsand,1900,1650,1.5,,\n",
         "1: the column 'grain_phi' occurs twice; leave one out"},
        {optional + "grain_phi\nsand,1900,1650,11\n",
         "2: grain_phi is 11; expected a number from -10 to 9"},
        {optional + "wall_mm\nglass,2300,5600,0\n",
         "2: wall_mm is 0; expected a number from 0.001 to 100"},
        {optional + "wall_mm,grain_phi\nsand,1900,1650,3,1.5\n",
         "2: a sea bed has no wall_mm; leave it or the sea bed's columns empty"},
        {optional + "roughness_m\nsand,1900,1650,smooth\n",
         "2: roughness_m 'smooth' is not a number"},
        {optional + "loss_parameter\nsand,1900,1650,0.01\n",
         "2: without a grain_phi a sea bed needs 'spectral_strength_cm4', 'volume_parameter', "
         "too; fill them in, or fill in grain_phi"},
        {"name,density,speed\n",
         "1: the first columns must be 'material,density_kg_m3,sound_speed_m_s' or 'Material, "
         "Density kg/m^3, Speed of Sound m/s'"},
        {header + "steel,7850\n", "2: 2 fields, but the header in line 1 has 3"},
        {header + "steel,heavy,5900\n", "2: density 'heavy' is not a number"},
        {header + "steel,7850,\n", "2: sound speed '' is not a number"},
        {header + "steel,7850,-5900\n",
         "2: sound speed is -5900; expected a number from 1e-09 to 1e+09"},
        {header + "steel,7850,inf\n",
         "2: sound speed is inf; expected a number from 1e-09 to 1e+09"},
        {header + "a,1,1\n\nb,1,1\na,2,2\n", "5: material 'a' is already in line 2"},
        {header + ",1,1\n", "2: the material has no name"}};
    check_faults(faulty, "m.csv:", [](const std::string& text) { parse_materials(text, "m.csv"); });
}

TEST_CASE("materials: the copy of a material has the row of the material") {
    const MaterialTable table =
        parse_materials(header + "Steel,7850,5900\nSteel.002,7700,5800\n", "m.csv");
    Scene scene;
    for (const char* name : {"Steel.001", "Steel.002", "Sand.001", "Sand.002"})
        scene.materials.push_back({name, 0.0, 0.0, 0.0F});
    CHECK(materials_csv(scene, table) ==
          "material,density_kg_m3,sound_speed_m_s\n"
          "Steel,7850,5900\nSteel.002,7700,5800\nSand,,\n");
    scene.materials.resize(2);
    resolve_materials(scene, table, Water{1000.0, 1500.0});
    CHECK(scene.materials[0].density_kg_m3 == 7850.0);
    CHECK(scene.materials[1].density_kg_m3 == 7700.0);
}

TEST_CASE("materials: reflection against water, finite at the limits of what is accepted") {
    const MaterialTable table = parse_materials(
        header + "steel,7850,5900\nvoid,1e-9,1e-9\nrock,1e9,1e9\nodd,1e-9,1e9\n", "m.csv");
    Scene scene;
    for (const Material& material : table.materials)
        scene.materials.push_back({material.name, 0.0, 0.0, 0.0F});
    resolve_materials(scene, table, Water{1000.0, 1500.0});
    // z = 7850 * 5900 = 46.315e6, z_w = 1.5e6: ((46.315 - 1.5) / (46.315 + 1.5))^2 = 0.878453.
    CHECK(scene.materials[0].reflection == approx(0.878453).epsilon(1e-6));
    CHECK(scene.materials[0].density_kg_m3 == 7850.0);
    for (const Water& water : {Water{1e-9, 1e-9}, Water{1e9, 1e9}, Water{1e9, 1e-9}}) {
        resolve_materials(scene, table, water);
        for (const Material& material : scene.materials) {
            CHECK(material.reflection >= 0.0F);
            CHECK(material.reflection <= 1.0F);
        }
    }
}
