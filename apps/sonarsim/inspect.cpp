#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include "commands.h"
#include "core/decibel.h"
#include "core/text.h"
#include "core/units.h"
#include "input/mission/scene_keys.h"
#include "input/scene/gltf/load.h"
#include "input/scene/images/read_image.h"
#include "input/scene/materials.h"
#include "input/scene/meshes/read_mesh.h"
#include "input/scene/placing/standing.h"
#include "input/scene/summary.h"
#include "mission_options.h"
#include "output/dataset/json.h"
#include "run/checks/find_warnings.h"
#include "simulate/assembly/placed_files.h"
#include "simulate/calibrated/equation/bottom.h"

namespace sonarsim {

namespace {

struct InspectArguments {
    std::filesystem::path scene;
    std::filesystem::path materials;  ///< "": none
    MeshOptions read_as;
    double pixel_m = 0.0;  ///< size of a pixel of a heightmap; 0: the file says it
    bool as_csv = false;
    double frequency_khz = 400.0;  ///< for a CSV of materials
    LogOptions log;
};

/// The backscattering strength in dB.
double strength_db(const Backscatter& material, double grazing_deg) {
    constexpr double min_power = 1e-40;
    const auto sine = static_cast<float>(sincos(radians(grazing_deg)).sin);
    return db_of_power(std::max(min_power, static_cast<double>(material.at(sine))));
}

Json strengths_json(const MaterialTable& table, const Scattering& scattering,
                    double frequency_khz) {
    Json json{{"frequency_khz", frequency_khz}, {"grazing_deg", Json::array()}};
    for (int degree = 1; degree <= 90; ++degree)
        json["grazing_deg"].push_back(degree);
    for (std::size_t k = 0; k < table.materials.size(); ++k) {
        Json& strengths = json["strength_db"][table.materials[k].name];
        for (int degree = 1; degree <= 90; ++degree)
            strengths.push_back(strength_db(scattering.materials[k], degree));
    }
    return json;
}

void print_strengths(const MaterialTable& table, const Scattering& scattering,
                     double frequency_khz) {
    constexpr std::array<int, 9> grazing_deg{5, 10, 20, 30, 45, 60, 75, 85, 90};
    std::size_t width = 0;
    for (const Material& material : table.materials)
        width = std::max(width, material.name.size());
    fmt::print("backscattering strength at {:g} kHz, dB, by the grazing angle in degrees\n{:{}}",
               frequency_khz, "", width);
    for (const int degree : grazing_deg)
        fmt::print(" {:6}", degree);
    for (std::size_t k = 0; k < table.materials.size(); ++k) {
        fmt::print("\n{:{}}", printable(table.materials[k].name), width);
        for (const int degree : grazing_deg)
            fmt::print(" {:6.1f}", strength_db(scattering.materials[k], degree));
    }
    fmt::print("\n");
}

/// Prints how the materials of a CSV scatter in fresh water, by the grazing angle.
void print_materials(const std::filesystem::path& file, double frequency_khz, bool as_json) {
    MaterialTable table = read_materials(file);
    const Water water;
    for (Material& material : table.materials)
        material.reflection = static_cast<float>(
            power_reflection(material.density_kg_m3, material.sound_speed_m_s, water));
    const Scattering scattering = scattering_of(table.materials, 1e3 * frequency_khz, water);
    if (as_json)
        fmt::print("{}\n", json_line(strengths_json(table, scattering, frequency_khz)));
    else
        print_strengths(table, scattering, frequency_khz);
}

/// The names with the number of triangles whose index in `owners` refers to them.
Json shares_json(const std::vector<std::string>& names, const std::vector<std::uint32_t>& owners) {
    std::vector<std::uint64_t> triangles(names.size());
    for (const std::uint32_t owner : owners)
        ++triangles[owner];
    Json json = Json::array();
    for (std::size_t i = 0; i < names.size(); ++i)
        json.push_back({{"name", names[i]}, {"triangles", triangles[i]}});
    return json;
}

Json scene_json(const Scene& scene) {
    std::vector<std::string> materials;
    for (const Material& material : scene.materials)
        materials.push_back(material.name);
    return {{"bounds_min_m", describe_vector(scene.bounds_min)},
            {"bounds_max_m", describe_vector(scene.bounds_max)},
            {"origin_m", describe_vector(scene.origin)},
            {"triangles", scene.triangles.size()},
            {"vertices", scene.vertices.size()},
            {"degenerate_triangles", scene.rejects.degenerate_triangles},
            {"non_finite_triangles", scene.rejects.non_finite_triangles},
            {"skipped_primitives", scene.rejects.skipped_primitives},
            {"vertex_rounding_m", scene.vertex_rounding_m},
            {"materials", shares_json(materials, scene.triangle_material)},
            {"instances", shares_json(scene.instances, scene.triangle_instance)}};
}

/// The acoustics of each material of the scene in the CSV; null for materials that it lacks.
Json acoustics_json(const Scene& scene, const MaterialTable& table) {
    Json json = Json::object();
    for (const Material& material : scene.materials) {
        const Material* const row = find_material(table.materials, material.name);
        if (!row) {
            json[material.name] = nullptr;
            continue;
        }
        json[material.name] = {
            {"density_kg_m3", row->density_kg_m3},
            {"sound_speed_m_s", row->sound_speed_m_s},
            {"reflection", power_reflection(row->density_kg_m3, row->sound_speed_m_s, Water{})}};
    }
    return json;
}

/// Questions about options that the user may have forgotten.
std::vector<std::string> questions_about(const InspectArguments& arguments, const PlacedFile& file,
                                         const Scene& scene, SceneFiles& models) {
    std::vector<std::string> questions;
    if (file.heightmap) return questions;
    const double length_m = (scene.bounds_max - scene.bounds_min).maxCoeff();
    const bool has_unit = !arguments.read_as.units.empty() || !is_mesh_file(arguments.scene);
    const std::string units =
        !has_unit ? unit_question(length_m, file.unit_m, usual_range_m, long_object) : "";
    if (!units.empty()) questions.push_back("it is " + units);
    const std::string up = up_question(file, surface_of(file, models));
    if (!up.empty()) questions.push_back(up);
    return questions;
}

PlacedFile file_of(const InspectArguments& arguments) {
    if (is_image_file(arguments.scene)) {
        HeightmapConfig map;
        map.file = arguments.scene;
        map.pixel_m = arguments.pixel_m;
        return file_of(map);
    }
    return file_of(arguments.scene, arguments.read_as.config(), {});
}

int inspect(const InspectArguments& arguments) {
    const std::string extension = arguments.scene.extension().string();
    if (extension == ".csv") {
        print_materials(arguments.scene, arguments.frequency_khz, arguments.log.json);
        return exit_done;
    }
    if (extension == ".yaml" || extension == ".yml") {
        throw InputError({arguments.scene.string()},
                         "is a mission; name the file of a mesh, or check the mission with "
                         "`sonarsim validate`");
    }
    const PlacedFile file = file_of(arguments);
    SceneFiles models;
    const Scene scene = load_scene_geometry(file, models);
    const std::vector<std::string> questions = questions_about(arguments, file, scene, models);
    MaterialTable table;
    if (!arguments.materials.empty()) table = read_materials(arguments.materials);
    log_warnings(reading_warnings(scene));
    for (const std::string& warning : unit_warnings(table.materials))
        spdlog::warn("{}", sentence(make_warning(WarningCode::reading, arguments.materials.string(),
                                                 warning)));
    if (arguments.as_csv) {
        fmt::print("{}", materials_csv(scene, table));
    } else if (arguments.log.json) {
        Json json = scene_json(scene);
        if (!arguments.materials.empty()) json["acoustics"] = acoustics_json(scene, table);
        if (is_mesh_file(file.file)) json["read_as"] = reading_of(file);
        json["questions"] = questions;
        fmt::print("{}\n", json_line(json));
    } else {
        if (is_mesh_file(file.file)) fmt::print("read as    {}\n", reading_of(file));
        fmt::print("{}", describe_scene(scene));
        for (const std::string& question : questions)
            fmt::print("\nquestion: {}", question);
        if (!questions.empty())
            fmt::print("\n(here --units mm and --up z; a mission has the keys units and up)\n");
        if (!arguments.materials.empty())
            fmt::print("{}", describe_materials(scene, table, Water{}));
    }
    return exit_done;
}

}  // namespace

void add_inspect(CLI::App& app, int& exit_code) {
    auto [command, arguments] = add_command(
        app, exit_code, "inspect",
        "Prints what is in a scene, or how the materials of a CSV scatter sound", "Look",
        {"sonarsim inspect hull.glb", "sonarsim inspect tyre.stl --units mm --up z",
         "sonarsim inspect bathymetry.tif", "sonarsim inspect materials.csv --frequency-khz 900"},
        inspect);
    command
        .add_option(
            "scene", arguments.scene,
            "The scene, a .gltf, .glb, .obj, .stl or .ply file, or an image of heights; or a "
            ".csv of materials")
        ->required();
    add_mesh_options(command, arguments.read_as, "m", "y");
    command
        .add_option("--pixel-m", arguments.pixel_m,
                    "Size of a pixel of an image of heights (default: as the file says)")
        ->check(CLI::PositiveNumber);
    command.add_option("--materials", arguments.materials,
                       "A CSV of materials: shows their reflection coefficients in fresh water");
    command.add_flag("--materials-csv", arguments.as_csv,
                     "Prints a CSV of the scene's materials to fill in, and nothing else");
    command
        .add_option("--frequency-khz", arguments.frequency_khz,
                    "For a CSV of materials: the frequency in fresh water (default: 400)")
        ->check(CLI::Range(1.0, 10000.0));
    add_log_options(command, arguments.log);
}

}  // namespace sonarsim
