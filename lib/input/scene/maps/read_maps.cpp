#include "input/scene/maps/read_maps.h"

#include <charconv>
#include <map>
#include <memory>

#include "core/elementary.h"
#include "core/error.h"
#include "core/text.h"
#include "input/mission/seabed_keys.h"
#include "input/scene/images/read_image.h"
#include "input/scene/maps/ground_maps.h"
#include "input/scene/objects.h"

namespace sonarsim {

namespace {

constexpr const char* sediment_section = "scene.sediment_map";
constexpr const char* backscatter_section = "scene.backscatter_map";
constexpr std::size_t max_texels = std::size_t{1} << 24;

/// The scene as seen from above, world x and y.
Eigen::AlignedBox2d ground_of(const Scene& scene) {
    return {scene.bounds_min.head<2>(), scene.bounds_max.head<2>()};
}

/// Calls use(pixel, row, column) for each texel of the map within the scene. `pixel` is null for
/// those that change nothing: they have no value, or are transparent. `section`: for messages.
TexelFrame for_each_texel(const AppliedMapConfig& map, const Image& image, const char* section,
                          const Scene& scene, const auto& use) {
    const Location where{map.file.string()};
    const Eigen::Vector2d origin(map.origin_m.data());
    const PixelGrid grid = grid_in_metres(image, map.pixel_m, section, where);
    const PixelWindow window =
        pixels_within(image, grid, ground_of(scene).translated(origin), max_texels, where);
    const int colours = image.colours();
    window.for_each([&](int row, int column) {
        const float* const pixel = image.pixel(row, column);
        const bool is_unknown =
            std::all_of(pixel, pixel + colours, [](float x) { return std::isnan(x); }) ||
            (colours < image.channels && pixel[colours] == 0.0F);
        use(is_unknown ? nullptr : pixel, row, column);
    });
    // Outer corners of pixels lie half a pixel before their centres.
    const Eigen::Vector2d corner(grid.x_m + (window.columns[0] - 0.5) * grid.column_m,
                                 grid.y_m + (window.rows[0] - 0.5) * grid.row_m);
    return {static_cast<int>(window.width()), static_cast<int>(window.height()), corner - origin,
            Eigen::Vector2d(1.0 / grid.column_m, 1.0 / grid.row_m)};
}

/// The number of a colour such as "#c8b478".
std::optional<double> parse_colour(const std::string& text) {
    std::uint32_t number = 0;
    const char* const end = text.data() + text.size();
    if (text.size() != 7 || text[0] != '#' ||
        std::from_chars(text.data() + 1, end, number, 16).ptr != end)
        return std::nullopt;
    return number;
}

/// A map of materials, from an image of one channel with a number for each, or of colours.
/// `materials` has numbers, or colours as "#c8b478", and indices into Scene::materials. InputError
/// for an image whose place is not known, for a key that does not fit the image's numbers or
/// colours, and for a pixel that has no material.
MaterialTexels read_material_map(
    const SedimentMapConfig& map, const Scene& scene,
    const std::vector<std::pair<std::string, std::uint32_t>>& materials) {
    const Image image = read_image(map.file);
    const Location where{map.file.string()};
    const bool colours = image.colours() == 3;
    if (image.colours() > 3)
        refuse(where,
               "has {} channels; a map of materials has one with numbers, or three with colours",
               image.channels);
    if (colours && (image.bits != 8 || image.is_float))
        refuse(where,
               "has colours of {} bits; make 8 of them, as with gdal_translate -ot Byte -scale",
               image.bits);
    MaterialTexels out;
    std::map<double, std::uint16_t> choices;
    for (const auto& [key, material] : materials) {
        const std::optional<double> number = colours ? parse_colour(key) : parse_number(key);
        if (!number) {
            refuse(where, "has {}, and {}.materials has '{}'; write {}: MATERIAL",
                   colours ? "colours" : "one channel of numbers", sediment_section, printable(key),
                   colours ? "\"#c8b478\"" : "7");
        }
        const auto same = std::ranges::find(out.materials, material);
        if (!choices.emplace(*number, same - out.materials.begin()).second)
            refuse(where, "has one material for each value, and {}.materials has '{}' twice",
                   sediment_section, printable(key));
        if (same == out.materials.end()) out.materials.push_back(material);
    }
    const auto use = [&](const float* pixel, int row, int column) {
        if (pixel == nullptr) return out.choice.push_back(MaterialTexels::own);
        double key = *pixel;
        if (colours) key = 65536.0 * key + 256.0 * double{pixel[1]} + double{pixel[2]};
        const auto found = choices.find(key);
        if (found != choices.end()) return out.choice.push_back(found->second);
        const std::string text = colours
                                     ? fmt::format("\"#{:06x}\"", static_cast<std::uint32_t>(key))
                                     : number_text(key);
        refuse(where, "row {}, column {}: {} has no material; add {}: MATERIAL to {}.materials{}",
               row, column, text, text, sediment_section,
               colours ? "" : ", or mark it: gdal_translate -a_nodata " + text);
    };
    out.frame = for_each_texel(map, image, sediment_section, scene, use);
    return out;
}

/// A map of decibels, of one channel, or one and alpha. Throws as above, and beyond 100 dB.
StrengthTexels read_strength_map(const AppliedMapConfig& map, const Scene& scene) {
    const Image image = read_image(map.file);
    const Location where{map.file.string()};
    if (image.colours() > 1)
        refuse(where,
               "has {} channels, and a map of decibels has one: take one out, as with "
               "gdal_translate -b 1",
               image.channels);
    StrengthTexels out;
    const auto use = [&](const float* pixel, int row, int column) {
        if (pixel == nullptr) return out.factor.push_back(1.0F);
        constexpr double max_db = 100.0;
        const double db = *pixel;
        if (!(std::fabs(db) <= max_db)) {
            refuse(where,
                   "row {0}, column {1}: {2} dB, and at most 100 are believed; mark it if it is "
                   "unknown (gdal_translate -a_nodata {2}), else make it decibels (gdal_translate "
                   "-ot Float32 -scale)",
                   row, column, number_text(db));
        }
        constexpr double per_db = 0.23025850929940457;  // ln(10) / 10
        out.factor.push_back(static_cast<float>(exponential(per_db * db)));
    };
    out.frame = for_each_texel(map, image, backscatter_section, scene, use);
    return out;
}

/// 1 for the instances that are the ground.
std::vector<char> ground_of(const SceneConfig& config, const Scene& scene) {
    const std::vector<std::string> patterns = bottom_patterns(config);
    if (patterns.empty()) {
        refuse(config.place,
               "maps need ground to lie on; write scene.bottom: [NAME] with the nodes of "
               "scene.file that are the ground");
    }
    std::vector<char> on(scene.instances.size(), 0);
    for (std::size_t i = 0; i < on.size(); ++i)
        on[i] = fits_instance(patterns, scene, i);
    for (const Body& body : scene.bodies)
        on[body.instance] = 0;
    return on;
}

/// The indices of the map's materials in the scene. Adds the materials that the scene lacks.
std::vector<std::pair<std::string, std::uint32_t>> add_materials(const Renaming& materials,
                                                                 const MaterialTable& table,
                                                                 const Location& place,
                                                                 Scene& scene) {
    std::vector<std::pair<std::string, std::uint32_t>> out;
    for (const auto& [key, name] : materials) {
        require_material(table, name, place);
        out.emplace_back(key, material_number(scene, name));
    }
    return out;
}

/// Warns if no texel lies on the scene.
void warn_of_place(const TexelFrame& frame, const std::string& section, Scene& scene) {
    const Eigen::Vector2d size(frame.width / frame.per_m.x(), frame.height / frame.per_m.y());
    Eigen::AlignedBox2d map(frame.corner_m);
    map.extend(Eigen::Vector2d(frame.corner_m + size));
    const Eigen::AlignedBox2d ground = ground_of(scene);
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

}  // namespace

void apply_ground_maps(const SceneConfig& config, const MaterialTable& table, const Water& water,
                       Scene& scene) {
    if (!config.sediment_map && !config.backscatter_map) return;
    std::optional<MaterialTexels> materials;
    std::optional<StrengthTexels> strengths;
    if (config.sediment_map) {
        const SedimentMapConfig& map = *config.sediment_map;
        const auto scene_materials = add_materials(map.materials, table, map.place, scene);
        resolve_materials(scene, table, water);
        materials = read_named_at(map.place,
                                  [&] { return read_material_map(map, scene, scene_materials); });
        warn_of_place(materials->frame, sediment_section, scene);
    }
    if (config.backscatter_map) {
        const AppliedMapConfig& map = *config.backscatter_map;
        strengths = read_named_at(map.place, [&] { return read_strength_map(map, scene); });
        warn_of_place(strengths->frame, backscatter_section, scene);
        if (!strengths->factor.empty() &&
            std::ranges::all_of(strengths->factor, [](float x) { return x == 1.0F; })) {
            scene.warnings.push_back(std::string(backscatter_section) +
                                     " changes nothing: each of its pixels is unknown or "
                                     "0 dB; check its values");
        }
    }
    scene.maps = std::make_shared<const GroundMaps>(std::move(materials), std::move(strengths),
                                                    ground_of(config, scene));
}

}  // namespace sonarsim
