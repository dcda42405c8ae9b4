#include "input/scene/maps/read_maps.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "core/elementary.h"
#include "core/error.h"
#include "core/text.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_texels = std::size_t{1} << 24;

/// Calls use(pixel, row, column) for each texel that is kept. `pixel` is null for those that change
/// nothing: they have no value, or are transparent.
template <class Use>
TexelFrame for_each_texel(const AppliedMapRule& rule, const Image& image, const Use& use) {
    const Location where{rule.map.file.string()};
    const Eigen::Vector2d origin(rule.map.origin_m[0], rule.map.origin_m[1]);
    const PixelGrid grid = grid_in_metres(image, rule.map.pixel_m, rule.section, where);
    const PixelWindow window =
        pixels_within(image, grid, {rule.needed_m.min() + origin, rule.needed_m.max() + origin},
                      max_texels, where);
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

}  // namespace

MaterialTexels read_material_map(
    const AppliedMapRule& rule, const Image& image,
    const std::vector<std::pair<std::string, std::uint32_t>>& materials) {
    const Location where{rule.map.file.string()};
    const bool colours = image.colours() == 3;
    if (image.colours() > 3)
        throw InputError(where, "has " + std::to_string(image.channels) +
                                    " channels; a map of materials has one with numbers, or three "
                                    "with colours");
    if (colours && (image.bits != 8 || image.is_float))
        throw InputError(where,
                         "has colours of " + std::to_string(image.bits) +
                             " bits; make 8 of them, as with gdal_translate -ot Byte -scale");
    MaterialTexels out;
    std::map<double, std::uint16_t> choices;
    for (const auto& [key, material] : materials) {
        const std::optional<double> number = colours ? parse_colour(key) : parse_number(key);
        if (!number) {
            throw InputError(where, (colours ? "has colours" : "has one channel of numbers") +
                                        std::string(", and ") + rule.section + ".materials has '" +
                                        printable(key) + "'; write " +
                                        (colours ? "\"#c8b478\": MATERIAL" : "7: MATERIAL"));
        }
        const auto same = std::ranges::find(out.materials, material);
        choices[*number] = static_cast<std::uint16_t>(same - out.materials.begin());
        if (same == out.materials.end()) out.materials.push_back(material);
    }
    out.frame = for_each_texel(rule, image, [&](const float* pixel, int row, int column) {
        if (pixel == nullptr) return out.choice.push_back(MaterialTexels::own);
        double key = *pixel;
        if (colours) key = 65536.0 * key + 256.0 * double{pixel[1]} + double{pixel[2]};
        const auto found = choices.find(key);
        if (found != choices.end()) return out.choice.push_back(found->second);
        const std::string text = colours
                                     ? fmt::format("\"#{:06x}\"", static_cast<std::uint32_t>(key))
                                     : number_text(key);
        throw InputError(
            where, fmt::format("row {}, column {}: {} has no material; add {}: MATERIAL to "
                               "{}.materials{}",
                               row, column, text, text, rule.section,
                               colours ? "" : ", or mark it: gdal_translate -a_nodata " + text));
    });
    return out;
}

StrengthTexels read_strength_map(const AppliedMapRule& rule, const Image& image) {
    const Location where{rule.map.file.string()};
    if (image.colours() > 1)
        throw InputError(where, "has " + std::to_string(image.channels) +
                                    " channels, and a map of decibels has one: take one out, as "
                                    "with gdal_translate -b 1");
    StrengthTexels out;
    out.frame = for_each_texel(rule, image, [&](const float* pixel, int row, int column) {
        if (pixel == nullptr) return out.factor.push_back(1.0F);
        constexpr double max_db = 100.0;
        const double db = *pixel;
        if (!(std::fabs(db) <= max_db)) {
            throw InputError(where,
                             fmt::format("row {0}, column {1}: {2} dB, and at most 100 are "
                                         "believed; mark it if it is unknown (gdal_translate "
                                         "-a_nodata {2}), else make it decibels (gdal_translate "
                                         "-ot Float32 -scale)",
                                         row, column, number_text(db)));
        }
        constexpr double per_db = 0.23025850929940457;  // ln(10) / 10
        out.factor.push_back(static_cast<float>(exponential(per_db * db)));
    });
    return out;
}

}  // namespace sonarsim
