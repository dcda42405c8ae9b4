#include "input/scene/materials.h"

#include <map>
#include <set>

#include "core/csv.h"
#include "core/elementary.h"
#include "core/file.h"
#include "core/input_limits.h"
#include "core/units.h"
#include "input/mission/limits.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_file_bytes = 1 << 24;

/// A column that a file may have or not. Its cells may be empty.
struct OptionalColumn {
    std::string_view name;
    double low, high;
    void (*put)(Material&, double);
};

constexpr std::array<OptionalColumn, 10> optional_columns{
    {{"lambert_db", -300.0, 20.0, [](Material& m, double value) { m.lambert_db = value; }},
     {"roughness_mm", 0.0, 50.0, [](Material& m, double value) { m.roughness_mm = value; }},
     {"slope_rms_deg", 0.0, 45.0, [](Material& m, double value) { m.slope_rms_deg = value; }},
     {"wall_mm", 0.001, 100.0, [](Material& m, double value) { m.wall_mm = value; }},
     {"grain_phi", -10.0, 9.0, [](Material& m, double value) { m.grain_phi = value; }},
     {"loss_parameter", 1e-6, 1.0, [](Material& m, double value) { m.loss_parameter = value; }},
     {"spectral_strength_cm4", 1e-9, 10.0,
      [](Material& m, double value) { m.spectral_strength_cm4 = value; }},
     {"spectral_exponent", 2.4, 3.9,
      [](Material& m, double value) { m.spectral_exponent = value; }},
     {"volume_parameter", 0.0, 1.0, [](Material& m, double value) { m.volume_parameter = value; }},
     // Older files have it; it has no effect.
     {"roughness_m", 0.0, 10.0, [](Material& /*m*/, double /*value*/) {}}}};

/// The optional columns of the table, in its order, from its fourth column on.
std::vector<OptionalColumn> optional_columns_of(const CsvTable& csv) {
    const std::vector<std::string> ours{"material", "density_kg_m3", "sound_speed_m_s"};
    const std::vector<std::string> holoocean{"Material", "Density kg/m^3", "Speed of Sound m/s"};
    const Location where{csv.file, csv.header.line};
    const std::vector<std::string>& names = csv.header.fields;
    const std::vector<std::string> first(
        names.begin(), names.begin() + std::min<std::ptrdiff_t>(3, std::ssize(names)));
    if (first != ours && first != holoocean) {
        refuse(where,
               "the first columns must be 'material,density_kg_m3,sound_speed_m_s' or "
               "'Material, Density kg/m^3, Speed of Sound m/s'");
    }
    std::vector<OptionalColumn> columns;
    for (auto name = names.begin() + 3; name != names.end(); ++name) {
        const auto column = std::ranges::find(optional_columns, *name, &OptionalColumn::name);
        if (column == optional_columns.end()) {
            refuse(where, "unknown column '{}'{}; docs/scenes.md lists them", printable(*name),
                   did_you_mean(*name, names_of(optional_columns)));
        }
        if (std::find(names.begin() + 3, name, *name) != name)
            refuse(where, "the column '{}' occurs twice; leave one out", *name);
        columns.push_back(*column);
    }
    return columns;
}

double number_within(const std::string& text, const char* quantity, double low, double high,
                     const Location& where) {
    const auto value = parse_number(text);
    if (!value) refuse(where, "{} '{}' is not a number", quantity, text);
    if (!(*value >= low && *value <= high))
        refuse(where, "{} is {}; expected a number from {} to {}", quantity, text, number_text(low),
               number_text(high));
    return *value;
}

/// InputError for a sea bed with some numbers of the model that lacks others, or has a wall.
void check_sea_bed(const Material& material, const Location& where) {
    if (material.wall_mm && (material.grain_phi || material.loss_parameter))
        refuse(where, "a sea bed has no wall_mm; leave it or the sea bed's columns empty");
    if (material.grain_phi) return;
    const std::array<std::pair<const char*, bool>, 3> needed{
        {{"loss_parameter", material.loss_parameter.has_value()},
         {"spectral_strength_cm4", material.spectral_strength_cm4.has_value()},
         {"volume_parameter", material.volume_parameter.has_value()}}};
    const auto given = std::ranges::count_if(needed, [](const auto& n) { return n.second; });
    if (given == std::ssize(needed) || (given == 0 && !material.spectral_exponent)) return;
    std::vector<std::string> missing;
    for (const auto& [name, is_given] : needed) {
        if (!is_given) missing.push_back("'" + std::string(name) + "'");
    }
    refuse(where, "without a grain_phi a sea bed needs {}, too; fill them in, or fill in grain_phi",
           listed(missing));
}

}  // namespace

MaterialTable read_materials(const std::filesystem::path& path) {
    return parse_materials(read_file(path, max_file_bytes), path.string());
}

MaterialTable parse_materials(std::string_view text, const std::string& file_name) {
    const CsvTable csv = parse_csv(text, file_name);
    const std::vector<OptionalColumn> optional = optional_columns_of(csv);
    MaterialTable table;
    table.file = csv.file;
    std::map<std::string, int> line_of;
    for (const CsvRow& row : csv.rows) {
        const Location where{csv.file, row.line};
        Material material;
        material.name = row.fields[0];
        if (material.name.empty()) refuse(where, "the material has no name");
        const auto [known, is_new] = line_of.emplace(material.name, row.line);
        if (!is_new)
            refuse(where, "material '{}' is already in line {}", material.name, known->second);
        material.density_kg_m3 =
            number_within(row.fields[1], "density", min_medium, largest_medium, where);
        material.sound_speed_m_s =
            number_within(row.fields[2], "sound speed", min_medium, largest_medium, where);
        bool has_inside = false;
        for (std::size_t i = 0; i < optional.size(); ++i) {
            const OptionalColumn& column = optional[i];
            const std::string& cell = row.fields[3 + i];
            if (cell.empty()) continue;
            column.put(material,
                       number_within(cell, column.name.data(), column.low, column.high, where));
            has_inside = has_inside || column.name == "lambert_db";
        }
        check_sea_bed(material, where);
        if (material.roughness_mm && !has_inside) material.lambert_db = -300.0;
        table.materials.push_back(std::move(material));
    }
    return table;
}

std::uint32_t material_number(Scene& scene, const std::string& name) {
    const auto found = std::ranges::find(scene.materials, name, &Material::name);
    const auto number = static_cast<std::uint32_t>(found - scene.materials.begin());
    if (found == scene.materials.end()) scene.materials.emplace_back().name = name;
    return number;
}

void resolve_materials(Scene& scene, const MaterialTable& table, const Water& water,
                       std::span<const std::string> users) {
    ErrorList errors;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material& material = scene.materials[i];
        if (material.density_kg_m3 > 0.0) continue;  // resolved already
        errors.attempt([&] {
            const Material* const found = find_material(table.materials, material.name);
            if (!found) {
                refuse(Location{table.file},
                       "lacks the material '{}'{}{}; add it to the CSV or give "
                       "scene.material_default",
                       printable(material.name), i < users.size() ? " of " + users[i] : "",
                       did_you_mean(material.name, names_of(table.materials)));
            }
            material = *found;
            material.reflection = static_cast<float>(
                power_reflection(material.density_kg_m3, material.sound_speed_m_s, water));
        });
    }
    errors.raise();
}

void require_material(const MaterialTable& table, const std::string& name, const Location& place) {
    const std::vector<std::string> known = names_of(table.materials);
    if (contains(known, name)) return;
    refuse(place, "unknown material '{}'{}; {} lists the materials", printable(name),
           did_you_mean(name, known), table.file);
}

std::string materials_csv(const Scene& scene, const MaterialTable& known) {
    std::string csv = "material,density_kg_m3,sound_speed_m_s\n";
    std::set<std::string> written;
    for (const Material& material : scene.materials) {
        const Material* const row = find_material(known.materials, material.name);
        const std::string name = row ? row->name : without_copy_number(material.name);
        if (!written.insert(name).second) continue;
        csv += csv_field(name);
        csv += row ? "," + number_text(row->density_kg_m3) + "," + number_text(row->sound_speed_m_s)
                   : ",,";
        csv += "\n";
    }
    return csv;
}

double facet_slope(const Material& material) {
    const SinCos slope = sincos(radians(material.slope_rms_deg));
    return slope.sin / slope.cos;
}

std::vector<std::string> unit_warnings(std::span<const Material> materials) {
    // Gases: below 10 kg/m^3 and 1,300 m/s. Liquids and solids are heavier than 30 kg/m^3.
    constexpr double lightest_solid = 30.0;
    constexpr double fast_for_a_gas = 1300.0;
    constexpr double slowest = 20.0;
    std::vector<std::string> warnings;
    for (const Material& material : materials) {
        if (material.density_kg_m3 <= 0.0 || material.sound_speed_m_s <= 0.0) continue;
        const std::string name = "material '" + printable(material.name) + "': ";
        const bool slow = material.sound_speed_m_s < slowest;
        if (slow) {
            warnings.push_back(
                fmt::format("{}a speed of sound of {} looks like km/s; the CSV takes m/s", name,
                            number_text(material.sound_speed_m_s)));
        }
        const double speed = material.sound_speed_m_s * (slow ? 1000.0 : 1.0);
        if (material.density_kg_m3 < lightest_solid && speed > fast_for_a_gas) {
            warnings.push_back(
                fmt::format("{}a density of {} looks like g/cm^3; the CSV takes kg/m^3", name,
                            number_text(material.density_kg_m3)));
        }
    }
    return warnings;
}

}  // namespace sonarsim
