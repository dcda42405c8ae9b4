#pragma once

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "input/scene/scene.h"

namespace sonarsim {

/// The materials of a CSV file, in its order. `reflection` is 0, since it depends on the water.
struct MaterialTable {
    std::string file;
    std::vector<Material> materials;
};

/// Reads `material,density_kg_m3,sound_speed_m_s`, or HoloOcean's header `Material, Density kg/m^3,
/// Speed of Sound m/s`. Further columns may follow, in any order: the members of Material from
/// `lambert_db` on, by their names. An empty cell, like a column that is missing, leaves the
/// default of Material. InputError with file:line for a header with other columns, for a wrong
/// number of fields, for a number out of its limits (core/input_limits.h has those of densities and
/// speeds), for a sea bed with neither a grain size nor all its numbers, and for a repeated one.
MaterialTable read_materials(const std::filesystem::path& path);
MaterialTable parse_materials(std::string_view text, const std::string& file_name);

/// InputError at `place`, where the mission names a material, if the table lacks it.
void require_material(const MaterialTable& table, const std::string& name, const Location& place);

/// The index of the material of this name in the scene, which gets it if need be.
std::uint32_t material_number(Scene& scene, const std::string& name);

/// Gives every new material of the scene its density, sound speed and reflection in `water`.
/// InputError with a line for each material that the table lacks. `users` names the first user of
/// each material of the scene for this message; it may be empty.
void resolve_materials(Scene& scene, const MaterialTable& table, const Water& water,
                       std::span<const std::string> users = {});

/// A CSV with a row for each material of the scene, filled in for those that `known` has.
std::string materials_csv(const Scene& scene, const MaterialTable& known);

/// The RMS slope of a material's facets, as a tangent.
double facet_slope(const Material& material);

/// One warning for each material whose density looks like g/cm^3 or whose speed looks like km/s: a
/// density below 30 with a speed of sound above that of any gas, or a speed below 20.
std::vector<std::string> unit_warnings(std::span<const Material> materials);

/// The row of a material of a scene: that of its name, else that of its name without the number of
/// a copy, so that "Steel.001" finds "Steel". Null if `rows` has neither.
inline const Material* find_material(std::span<const Material> rows, const std::string& name) {
    for (const std::string& wanted : {name, without_copy_number(name)}) {
        const auto row = std::ranges::find(rows, wanted, &Material::name);
        if (row != rows.end()) return &*row;
    }
    return nullptr;
}

}  // namespace sonarsim
