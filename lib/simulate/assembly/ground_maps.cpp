#include "simulate/assembly/ground_maps.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "input/scene/images/read_image.h"
#include "input/scene/maps/ground_maps.h"
#include "input/scene/maps/read_maps.h"
#include "input/scene/objects.h"
#include "simulate/assembly/ground_parts.h"

namespace sonarsim {

namespace {

/// 1 for the instances that are the ground.
std::vector<char> ground_of(const SceneConfig& config, const Scene& scene) {
    const std::vector<std::string> patterns = bottom_patterns(config);
    if (patterns.empty()) {
        throw InputError(config.place,
                         "maps need ground to lie on; write scene.bottom: [NAME] with the nodes of "
                         "scene.file that are the ground");
    }
    std::vector<char> on(scene.instances.size(), 0);
    for (std::size_t i = 0; i < on.size(); ++i) {
        on[i] = std::ranges::any_of(patterns, [&](const std::string& pattern) {
            return fits_pattern(pattern, scene.instances[i]);
        });
    }
    for (const Body& body : scene.bodies)
        on[body.instance] = 0;
    return on;
}

AppliedMapRule rule_of(const AppliedMapConfig& map, const std::string& section,
                       const Scene& scene) {
    return {map, section, {scene.bounds_min.head<2>(), scene.bounds_max.head<2>()}};
}

/// The indices of the map's materials in the scene. Adds the materials that the scene lacks.
std::vector<std::pair<std::string, std::uint32_t>> add_materials(const Renaming& materials,
                                                                 const MaterialTable& table,
                                                                 const Location& place,
                                                                 Scene& scene) {
    std::vector<std::pair<std::string, std::uint32_t>> out;
    for (const auto& [key, name] : materials) {
        require_material(table, name, place);
        const auto found = std::ranges::find(scene.materials, name, &Material::name);
        out.emplace_back(key, static_cast<std::uint32_t>(found - scene.materials.begin()));
        if (found != scene.materials.end()) continue;
        Material& material = scene.materials.emplace_back();
        material.name = name;
    }
    return out;
}

/// Warns if no texel lies on the scene.
void warn_of_place(const TexelFrame& frame, const std::string& section, Scene& scene) {
    const Eigen::Vector2d a = frame.corner_m;
    const Eigen::Vector2d size(frame.width / frame.per_m.x(), frame.height / frame.per_m.y());
    Eigen::AlignedBox2d map(a);
    map.extend(Eigen::Vector2d(a + size));
    const Eigen::AlignedBox2d ground(scene.bounds_min.head<2>(), scene.bounds_max.head<2>());
    if (map.intersects(ground)) return;
    const auto text = [](const Eigen::AlignedBox2d& box) {
        const auto metres = [](double x) { return number_text(std::round(x)); };
        return "x " + metres(box.min().x()) + " to " + metres(box.max().x()) + " m, y " +
               metres(box.min().y()) + " to " + metres(box.max().y()) + " m";
    };
    scene.warnings.push_back(section + " lies outside the scene and changes nothing: the map has " +
                             text(map) + ", the scene " + text(ground) +
                             "; write the point of the map that is x = 0, y = 0 as origin_m");
}

/// Reads one map; its errors name the mission.
template <class Read>
auto read_map(const AppliedMapConfig& map, const Read& read) {
    try {
        return read();
    } catch (const InputError& error) {
        if (map.place.file.empty()) throw;
        throw named_at(error, map.place);
    }
}

}  // namespace

void apply_ground_maps(const SceneConfig& config, const MaterialTable& table, const Water& water,
                       Scene& scene) {
    if (!config.sediment_map && !config.backscatter_map) return;
    std::optional<MaterialTexels> materials;
    std::optional<StrengthTexels> strengths;
    if (config.sediment_map) {
        const std::string section = "scene.sediment_map";
        const SedimentMapConfig& map = *config.sediment_map;
        const auto scene_materials = add_materials(map.materials, table, map.place, scene);
        resolve_materials(scene, table, water);
        materials = read_map(map, [&] {
            return read_material_map(rule_of(map, section, scene), read_image(map.file),
                                     scene_materials);
        });
        warn_of_place(materials->frame, section, scene);
    }
    if (config.backscatter_map) {
        const std::string section = "scene.backscatter_map";
        const AppliedMapConfig& map = *config.backscatter_map;
        strengths = read_map(map, [&] {
            return read_strength_map(rule_of(map, section, scene), read_image(map.file));
        });
        warn_of_place(strengths->frame, section, scene);
        if (!strengths->factor.empty() &&
            std::ranges::all_of(strengths->factor, [](float x) { return x == 1.0F; })) {
            scene.warnings.push_back(section +
                                     " changes nothing: each of its pixels is unknown or "
                                     "0 dB; check its values");
        }
    }
    scene.maps = std::make_shared<const GroundMaps>(std::move(materials), std::move(strengths),
                                                    ground_of(config, scene));
}

}  // namespace sonarsim
