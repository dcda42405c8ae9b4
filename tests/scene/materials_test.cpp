#include "scene/materials.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "support/approx.h"

using namespace sonarsim;

namespace {

const std::string header = "material,density_kg_m3,sound_speed_m_s\n";

void check_error(const std::string& text, const std::string& message) {
    CHECK_THROWS_WITH_AS(parse_materials(text, "m.csv"), message.c_str(), InputError);
}

Scene scene_of(const std::vector<std::string>& names) {
    Scene scene;
    for (const std::string& name : names)
        scene.materials.push_back({name, 0.0, 0.0, 0.0F});
    return scene;
}

}  // namespace

TEST_SUITE("scene") {
    TEST_CASE("materials: HoloOcean's header, byte order mark, CRLF, comments") {
        const MaterialTable table = parse_materials(
            "\xEF\xBB\xBF"
            "Material, Density kg/m^3, Speed of Sound m/s\r\n# note\r\n\r\nsteel, 7850, 5900\r\n",
            "m.csv");
        REQUIRE(table.materials.size() == 1);
        CHECK(table.materials[0].name == "steel");
        CHECK(table.materials[0].sound_speed_m_s == 5900.0);
    }

    TEST_CASE("materials: optional columns stand in any order, and cells may be empty") {
        const std::string first = "material,density_kg_m3,sound_speed_m_s,";
        const MaterialTable table =
            parse_materials(first +
                                "roughness_m,grain_phi,slope_rms_deg,lambert_db\n"
                                "sand,1900,1650,,1.5,,\n"
                                "plate,7850,5890,1e-6,,0,-300\n",
                            "m.csv");
        const Material& sand = table.materials[0];
        CHECK(sand.grain_phi == 1.5);
        CHECK(sand.lambert_db == Material{}.lambert_db);
        CHECK(sand.slope_rms_deg == Material{}.slope_rms_deg);
        const Material& plate = table.materials[1];
        CHECK(!plate.grain_phi);
        CHECK(plate.slope_rms_deg == 0.0);
        CHECK(plate.lambert_db == -300.0);

        const MaterialTable silt = parse_materials(
            "Material, Density kg/m^3, Speed of Sound m/s, volume_parameter, loss_parameter, "
            "spectral_exponent, spectral_strength_cm4\nsilt, 1700, 1575, 0.001, 0.004, 3.3, 5e-4\n",
            "m.csv");
        CHECK(silt.materials[0].volume_parameter == 0.001);
        CHECK(silt.materials[0].loss_parameter == 0.004);
        CHECK(silt.materials[0].spectral_exponent == 3.3);
        CHECK(silt.materials[0].spectral_strength_cm4 == 5e-4);

        check_error(first + "grain_fi\nsand,1900,1650,1.5\n",
                    "m.csv:1: unknown column 'grain_fi' (did you mean 'grain_phi'?); "
                    "docs/scenes.md lists them");
        check_error(first + "grain_phi,lambert_db,grain_phi\nsand,1900,1650,1.5,,\n",
                    "m.csv:1: the column 'grain_phi' occurs twice; leave one out");
        check_error(first + "grain_phi\nsand,1900,1650,11\n",
                    "m.csv:2: grain_phi is 11; expected a number from -10 to 9");
        check_error(first + "roughness_m\nsand,1900,1650,smooth\n",
                    "m.csv:2: roughness_m 'smooth' is not a number");
        check_error(first + "loss_parameter\nsand,1900,1650,0.01\n",
                    "m.csv:2: without a grain_phi a sea bed needs 'spectral_strength_cm4', "
                    "'volume_parameter', too; fill them in, or fill in grain_phi");
    }

    TEST_CASE("materials: errors name file and line") {
        check_error(
            "name,density,speed\n",
            "m.csv:1: the first columns must be 'material,density_kg_m3,sound_speed_m_s' or "
            "'Material, Density kg/m^3, Speed of Sound m/s'");
        check_error(header + "steel,7850\n", "m.csv:2: 2 fields, but the header in line 1 has 3");
        check_error(header + "steel,heavy,5900\n", "m.csv:2: density 'heavy' is not a number");
        check_error(header + "steel,7850,\n", "m.csv:2: sound speed '' is not a number");
        check_error(header + "steel,7850,-5900\n",
                    "m.csv:2: sound speed is -5900; expected a number from 1e-09 to 1e+09");
        check_error(header + "steel,7850,inf\n",
                    "m.csv:2: sound speed is inf; expected a number from 1e-09 to 1e+09");
        check_error(header + "a,1,1\n\nb,1,1\na,2,2\n",
                    "m.csv:5: material 'a' is already in line 2");
        check_error(header + ",1,1\n", "m.csv:2: the material has no name");
    }

    TEST_CASE("materials: reflection against water") {
        const MaterialTable table = parse_materials(header + "steel,7850,5900\n", "m.csv");
        Scene scene = scene_of({"steel"});
        resolve_materials(scene, table, Water{1000.0, 1500.0});
        // z = 7850 * 5900 = 46.315e6, z_w = 1.5e6: ((46.315 - 1.5) / (46.315 + 1.5))^2 = 0.878453.
        CHECK(scene.materials[0].reflection == test::approx(0.878453).epsilon(1e-6));
        CHECK(scene.materials[0].density_kg_m3 == 7850.0);
    }

    TEST_CASE("materials: reflections are finite at the limits of what is accepted") {
        const MaterialTable table =
            parse_materials(header + "void,1e-9,1e-9\nrock,1e9,1e9\nodd,1e-9,1e9\n", "m.csv");
        Scene scene = scene_of({"void", "rock", "odd"});
        for (const Water& water : {Water{1e-9, 1e-9}, Water{1e9, 1e9}, Water{1e9, 1e-9}}) {
            resolve_materials(scene, table, water);
            for (const Material& material : scene.materials) {
                CHECK(material.reflection >= 0.0F);
                CHECK(material.reflection <= 1.0F);
            }
        }
    }
}
