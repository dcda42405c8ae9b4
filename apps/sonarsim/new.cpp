#include <regex>
#include <set>

#include "commands.h"
#include "core/csv.h"
#include "core/error.h"
#include "core/text.h"
#include "input/mission/parse.h"
#include "input/mission/preset.h"
#include "input/scene/gltf/load.h"
#include "input/scene/materials.h"
#include "input/scene/meshes/read_mesh.h"
#include "input/scene/placing/standing.h"
#include "input/scene/scene.h"
#include "input/scene/seabed/seabed.h"
#include "mission_options.h"
#include "run/job/folder.h"
#include "simulate/assembly/placed_files.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

namespace {

/// A CSV of materials that is a first guess.
struct GuessedMaterials {
    std::string csv;                   ///< a guess has a comment above its row
    std::vector<std::string> guesses;  ///< "material Hull_paint: steel"
    std::string default_material;      ///< for surfaces without a material; "": there are none
};

constexpr const char* usual_material = "steel";
constexpr const char* usual_bed = "sand";
constexpr const char* nameless = "(no material)";  // as load_scene_geometry()
constexpr std::size_t largest_table = std::size_t{1} << 24;

/// The row of the same name, else of the longest name that stands in it as a word; else null.
const CsvRow* row_of(const CsvTable& table, const std::string& name) {
    const CsvRow* best = nullptr;
    for (const CsvRow& row : table.rows) {
        const std::string& known = row.fields.front();
        if (known == name) return &row;
        const std::regex word("(^|[^a-z])" + known + "([^a-z]|$)", std::regex::icase);
        if ((!best || known.size() > best->fields.front().size()) && std::regex_search(name, word))
            best = &row;
    }
    return best;
}

CsvTable known_materials() {
    const std::filesystem::path file = shipped_file("../scenes/materials.csv");
    if (file.empty())
        throw InputError("scenes/materials.csv, which comes with the program, is not there");
    return read_csv(file, largest_table);
}

/// Rows for the materials of a mesh and those of `beds`, from the program's scenes/materials.csv:
/// by the same name, else by the longest word in it ("Hull_wood.001": wood), else steel, or sand
/// for a bed. InputError when the table is missing.
GuessedMaterials guess_materials(const Scene& mesh, const std::vector<std::string>& beds) {
    const CsvTable table = known_materials();
    GuessedMaterials out{listed(table.header.fields, ",") + "\n", {}, ""};
    std::set<std::string> written;
    const auto add = [&](const std::string& name, const char* usual) {
        if (!written.insert(name).second) return;
        const CsvRow* row = row_of(table, name);
        if (!row) row = row_of(table, usual);
        std::vector<std::string> fields = row->fields;
        if (fields.front() != name) {
            out.guesses.push_back("material " + name + ": " + fields.front());
            out.csv += "# guess: the numbers of " + fields.front() + "\n";
            fields.front() = csv_field(name);
        }
        out.csv += listed(fields, ",") + "\n";
    };
    for (const Material& material : mesh.materials) {
        if (material.name != nameless) {
            add(without_copy_number(material.name), usual_material);
            continue;
        }
        out.default_material = usual_material;
        out.guesses.push_back(std::string("surfaces without a material: ") + usual_material);
        add(usual_material, usual_material);
    }
    for (const std::string& bed : beds)
        add(bed, usual_bed);
    return out;
}

namespace fs = std::filesystem;

struct NewArguments {
    fs::path mesh;
    std::string preset;  ///< "": by the size of the mesh
    std::string bed = "sand";
    MeshOptions read_as;  ///< "": as the mesh seems to be meant
    fs::path out;         ///< "": NAME.yaml in the current folder
    LogOptions log;
};

/// A mesh, read as it seems to be meant.
struct ReadMesh {
    Scene scene;
    MeshConfig config;
    std::string keys;  ///< ", units: mm, up: z" for the mission
    std::vector<std::string> guesses;
};

/// Reads a mesh as given, else as `inspect` asks. InputError for no mesh or no surface.
ReadMesh read_as_meant(const NewArguments& arguments) {
    const fs::path& path = arguments.mesh;
    ReadMesh mesh;
    SceneFiles models;
    mesh.config = arguments.read_as.config();
    const PlacedFile as_gltf = file_of(path, mesh.config, {});
    mesh.scene = load_scene_geometry(as_gltf, models);
    if (mesh.scene.triangles.empty()) throw InputError({path.string()}, "has no triangles");
    const double length_m = (mesh.scene.bounds_max - mesh.scene.bounds_min).maxCoeff();
    // A glTF file is in metres with y up, unless options say otherwise.
    const bool has_unit = !arguments.read_as.units.empty();
    const std::string unit = !has_unit && is_mesh_file(path)
                                 ? unit_question(length_m, 1.0, usual_range_m, long_object)
                                 : "";
    const std::string up =
        arguments.read_as.up.empty() ? up_question(as_gltf, surface_of(as_gltf, models)) : "";
    if (!unit.empty()) mesh.config.units = LengthUnit::mm;
    if (!up.empty()) mesh.config.up = UpAxis::z;
    if (!unit.empty()) mesh.guesses.push_back("the file is " + unit);
    if (!up.empty()) mesh.guesses.push_back(up);
    if (up.empty() && arguments.read_as.up.empty() && is_mesh_file(path))
        mesh.guesses.push_back("y points up; if the file's z does, give --up z");
    if (has_unit || is_mesh_file(path))
        mesh.keys = ", units: " + (has_unit ? arguments.read_as.units : unit.empty() ? "m" : "mm");
    if (!arguments.read_as.up.empty() || is_mesh_file(path))
        mesh.keys += mesh.config.up == UpAxis::y ? ", up: y" : ", up: z";
    mesh.config.up_given = true;
    if (!unit.empty() || !up.empty())
        mesh.scene = load_scene_geometry(file_of(path, mesh.config, {}), models);
    return mesh;
}

/// The name of the object and of the mission: that of the file, without what `look_at`, YAML and
/// shells may read otherwise, and none that means something else in the mission.
std::string safe_name(const fs::path& mesh) {
    const std::regex unsafe(R"(^-+|[\x01-,./:-@\[-`{-\x7f]+)");
    const std::string name = std::regex_replace(mesh.stem().string(), unsafe, "_");
    const std::set<std::string> reserved{all_objects, rock_class, "bottom", "heightmap", "seabed"};
    return reserved.contains(name) ? name + "_mesh" : name;
}

/// A preset as a mission in `folder` names it. InputError if there is none.
std::string preset_in(const fs::path& folder, const std::string& kind, const std::string& name) {
    std::string shipped = kind + "/" + name + ".yaml";
    if (!shipped_file(shipped).empty()) return shipped;
    if (fs::is_regular_file(name)) return fs::proximate(fs::absolute(name), folder).string();
    throw InputError({name}, "is not a file, and no preset of this name came with the program" +
                                 shipped_hint(name, kind));
}

/// Lengths of the mission by the diagonal of the mesh, m.
struct Distances {
    double near, far, reach, cell;
};

Distances distances_of(double diagonal, double longest, double ripple) {
    Distances out{0.6 * diagonal + 1.0, 1.2 * diagonal + 2.0, 0.0, 0.0};
    out.reach = std::min(longest, out.far + 0.6 * diagonal);
    out.far = std::clamp(out.far, out.near, std::max(out.near, out.reach));
    out.cell = std::min(std::clamp(out.reach / 100.0, 0.03, 0.5), ripple / 4.0);
    return out;
}

std::string mission_text(const NewArguments& arguments, const ReadMesh& mesh, const fs::path& csv,
                         const std::string& default_material, const Distances& at) {
    const fs::path folder = fs::absolute(csv).parent_path();
    const std::string name = quoted_text(safe_name(arguments.mesh));
    const Eigen::Vector3d middle = 0.5 * (mesh.scene.bounds_min + mesh.scene.bounds_max);
    const double diagonal = (mesh.scene.bounds_max - mesh.scene.bounds_min).norm();
    const std::string preset = !arguments.preset.empty() ? arguments.preset
                               : diagonal < 15.0         ? "oculus_m1200d_1200khz"
                                                         : "oculus_m750d_750khz";
    std::string text = "# Made by `sonarsim new`.\n";
    for (const std::string& guess : mesh.guesses)
        text += "# guess: " + guess + "\n";
    text += fmt::format("scene:\n  materials: {}  # has guesses\n",
                        quoted_text(csv.filename().string()));
    if (!default_material.empty())
        text += fmt::format("  material_default: {}  # guess\n", default_material);
    text += fmt::format("  seabed: {{preset: {}, cell_m: {:.2g}, class: bottom}}\n",
                        quoted_text(preset_in(folder, seabed_presets, arguments.bed)), at.cell);
    text += fmt::format(
        "  objects:\n    - {{name: {}, class: {}, file: {}{},\n"
        "       place: on_bottom, position_m: [{:.3f}, {:.3f}, 0]}}  # rpy_deg turns it\n",
        name, name, quoted_text(fs::proximate(fs::absolute(arguments.mesh), folder).string()),
        mesh.keys, 0.0 - middle.x(), 0.0 - middle.y());
    text += fmt::format(
        "trajectory:  # poses around it\n  look_at: {}\n  count: 20\n"
        "  range_m: [{:.3g}, {:.3g}]  # to its middle\n  height_m: [{:.2g}, {:.2g}]\n",
        name, at.near, at.far, 0.25 * at.near, 0.5 * at.near);
    text += fmt::format("sensors:\n  fls:\n    preset: {}\n",
                        quoted_text(preset_in(folder, sensor_presets, preset)));
    if (at.reach > 0.0) text += fmt::format("    range_max_m: {:.3g}\n", at.reach);
    return text + "output: {labels: [objects]}\nlabels: {background: [bottom]}\n";
}

/// The materials that a made bed names.
std::vector<std::string> materials_of(const SeabedConfig& bed) {
    std::vector<std::string> names;
    for (const BedSedimentConfig& sediment : bed.sediments)
        names.push_back(sediment.material);
    if (!bed.material.empty()) names.push_back(bed.material);
    if (bed.rocks && !bed.rocks->material.empty()) names.push_back(bed.rocks->material);
    return names;
}

/// Writes a file that is not there yet.
void write_new(const fs::path& file, const std::string& text) {
    if (!create_once(fs::absolute(file), text))
        throw InputError({file.string()}, "is there already; give another name with --out");
}

int make_mission(const NewArguments& arguments) {
    const fs::path out =
        arguments.out.empty() ? fs::path(safe_name(arguments.mesh) + ".yaml") : arguments.out;
    for (const std::string& file : {arguments.mesh.string(), out.string()}) {
        if (printable(file) != file)
            throw InputError({printable(file)},
                             "a mission names only UTF-8 without control characters; rename it");
    }
    const fs::path folder = fs::absolute(out).parent_path();
    const fs::path csv = folder / (out.stem().string() + "_materials.csv");
    for (const fs::path& file : {out, csv.lexically_proximate(fs::current_path())}) {
        if (fs::exists(file))
            throw InputError({file.string()}, "is there already; give another name with --out");
    }
    const ReadMesh mesh = read_as_meant(arguments);
    const Eigen::Vector3d size = mesh.scene.bounds_max - mesh.scene.bounds_min;
    const Mission first =
        parse_mission(mission_text(arguments, mesh, csv, "", {1.0, 2.0, 0.0, 0.01}), out.string(),
                      folder, {}, sonar_keys());
    if (first.sensors.front().kind != SonarKind::imaging)
        throw InputError({arguments.preset}, "is no imaging sonar, which a new mission needs");
    const SeabedConfig& bed = *first.scene.seabed;
    const Distances at = distances_of(size.norm(), first.sensors.front().range_max_m,
                                      bed.ripples ? bed.ripples->length_m : 2.0);
    const GuessedMaterials materials = guess_materials(mesh.scene, materials_of(bed));
    fs::create_directories(folder);
    write_new(csv, materials.csv);
    write_new(out, mission_text(arguments, mesh, csv, materials.default_material, at));
    if (!arguments.log.prints_result()) return exit_done;
    const std::string name = out.string();
    print_result("mission", name);
    print_result("materials", csv.lexically_proximate(fs::current_path()).string());
    print_result("size",
                 fmt::format("{:.3g} x {:.3g} x {:.3g} m, read as {}", size.x(), size.y(), size.z(),
                             reading_of(file_of(arguments.mesh, mesh.config, {}))));
    for (const std::vector<std::string>& some : {mesh.guesses, materials.guesses}) {
        for (const std::string& guess : some)
            print_result("guess", guess);
    }
    print_result("next", "sonarsim preview " + name);
    print_result("", "sonarsim render " + name);
    return exit_done;
}

}  // namespace

void add_new(CLI::App& app, int& exit_code) {
    auto [command, arguments] = add_command(
        app, exit_code, "new", "Writes a mission around a mesh, with its guesses marked", "Make",
        {"sonarsim new hull.glb", "sonarsim new tyre.stl --preset gemini_720is --bed mud"},
        make_mission);
    command.add_option("mesh", arguments.mesh, "A .gltf, .glb, .obj, .stl or .ply file")
        ->required();
    command.add_option("--preset", arguments.preset,
                       "An imaging sonar, of configs/sensors or a file (default: an Oculus)");
    command.add_option("--bed", arguments.bed,
                       "The sea bed, of configs/seabeds or a file (default: sand)");
    add_mesh_options(command, arguments.read_as, "a guess", "a guess");
    command
        .add_option("--out", arguments.out,
                    "The mission (default: NAME.yaml in the current folder)")
        ->type_name("FILE.yaml");
    add_log_options(command, arguments.log, LogResult::text);
}

}  // namespace sonarsim
