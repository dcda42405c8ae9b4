#include "scene/maps/read_maps.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/elementary.h"
#include "core/error.h"
#include "core/text.h"
#include "scene/images/image_place.h"
#include "scene/images/unknown_pixels.h"

namespace sonarsim {

namespace {

/// An image that is laid on the ground, and the part of it that is kept.
struct LaidImage {
    Image image;
    PixelWindow window;
    TexelFrame frame;
    UnknownPixels unknown;
    Location where;

    LaidImage(const LaidMapRule& rule, Image of_file)
        : image(std::move(of_file)),
          unknown(rule.no_data ? rule.no_data : image.no_data),
          where{rule.file.string()} {
        const Eigen::Vector2d origin(rule.origin_m[0], rule.origin_m[1]);
        const PixelGrid grid =
            grid_in_metres(image, rule.pixel_m, rule.size_m, rule.section, where);
        window = pixels_within(image, grid,
                               {rule.needed_m.min() + origin, rule.needed_m.max() + origin});
        if (window.width() * window.height() > most_map_texels) {
            throw InputError(
                where, fmt::format("the scene needs {} x {} pixels of it, and at most 2^24 have "
                                   "room; make it coarser with gdal_translate -outsize 50% 50%, "
                                   "or cut a part out with gdal_translate -projwin",
                                   window.width(), window.height()));
        }
        frame.width = static_cast<int>(window.width());
        frame.height = static_cast<int>(window.height());
        frame.per_m = {1.0 / grid.column_m, 1.0 / grid.row_m};
        // Outer corners of pixels lie half a pixel before their centres.
        frame.corner_m = Eigen::Vector2d(grid.x_m + (window.first_column - 0.5) * grid.column_m,
                                         grid.y_m + (window.first_row - 0.5) * grid.row_m) -
                         origin;
    }

    /// Calls use(pixel, row, column) for every pixel that is kept.
    template <class Use>
    void for_each(const Use& use) const {
        for (int row = window.first_row; row < window.last_row; ++row) {
            for (int column = window.first_column; column < window.last_column; ++column)
                use(image.pixel(row, column), row, column);
        }
    }
};

std::string place_text(int row, int column) {
    return "row " + std::to_string(row) + ", column " + std::to_string(column) + ": ";
}

using Choices = std::map<double, std::uint16_t>;

/// Three whole numbers of 8 bits as one.
double colour_number(double red, double green, double blue) {
    return 65536.0 * red + 256.0 * green + blue;
}

std::optional<double> parse_colour(const std::string& text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    double number = 0.0;
    for (const char letter : text.substr(1)) {
        const std::string_view digits = "0123456789abcdef";
        const auto lower = static_cast<char>(letter >= 'A' && letter <= 'F' ? letter + 32 : letter);
        const std::size_t digit = digits.find(lower);
        if (digit == std::string_view::npos) return std::nullopt;
        number = 16.0 * number + static_cast<double>(digit);
    }
    return number;
}

std::string key_text(double key, bool colours) {
    if (!colours) return number_text(key);
    return fmt::format("\"#{:06x}\"", static_cast<std::uint32_t>(key));
}

}  // namespace

MaterialTexels read_material_map(
    const LaidMapRule& rule, Image of_file,
    const std::vector<std::pair<std::string, std::uint32_t>>& materials) {
    const LaidImage laid(rule, std::move(of_file));
    const Image& image = laid.image;
    const bool colours = image.channels == 3 || image.channels == 4;
    const bool has_alpha = image.channels % 2 == 0;
    if (image.channels > 4)
        throw InputError(laid.where, "has " + std::to_string(image.channels) +
                                         " channels; a map of materials has one with numbers, or "
                                         "three with colours");
    if (colours && (image.bits != 8 || image.is_float))
        throw InputError(laid.where,
                         "has colours of " + std::to_string(image.bits) +
                             " bits; make 8 of them, as with gdal_translate -ot Byte -scale");
    MaterialTexels out;
    out.frame = laid.frame;
    Choices choices;
    for (const auto& [key, material] : materials) {
        const std::optional<double> number = colours ? parse_colour(key) : parse_number(key);
        if (!number) {
            throw InputError(laid.where, (colours ? "has colours" : "has one channel of numbers") +
                                             std::string(", and ") + rule.section +
                                             ".materials has '" + printable(key) + "'; write " +
                                             (colours ? "\"#c8b478\": MATERIAL" : "7: MATERIAL"));
        }
        const auto same = std::ranges::find(out.materials, material);
        const auto choice = static_cast<std::uint16_t>(same - out.materials.begin());
        if (same == out.materials.end()) out.materials.push_back(material);
        choices[*number] = choice;
    }
    out.choice.reserve(laid.window.width() * laid.window.height());
    laid.for_each([&](const float* pixel, int row, int column) {
        const bool is_unknown = std::all_of(pixel, pixel + (colours ? 3 : 1),
                                            [&](float v) { return laid.unknown.has(v); });
        if (is_unknown || (has_alpha && pixel[image.channels - 1] == 0.0F)) {
            out.choice.push_back(MaterialTexels::own);
            return;
        }
        const double key =
            colours ? colour_number(pixel[0], pixel[1], pixel[2]) : static_cast<double>(pixel[0]);
        const auto found = choices.find(key);
        if (found == choices.end()) {
            throw InputError(laid.where,
                             place_text(row, column) + key_text(key, colours) +
                                 " has no material; add " + key_text(key, colours) +
                                 ": MATERIAL to " + rule.section + ".materials" +
                                 (colours ? "" : ", or write no_data: " + number_text(key)));
        }
        out.choice.push_back(found->second);
    });
    return out;
}

StrengthTexels read_strength_map(const LaidMapRule& rule, Image of_file, double scale_db,
                                 double offset_db) {
    const LaidImage laid(rule, std::move(of_file));
    const Image& image = laid.image;
    if (image.channels > 2)
        throw InputError(laid.where, "has " + std::to_string(image.channels) +
                                         " channels, and a map of decibels has one: take one out, "
                                         "as with gdal_translate -b 1");
    StrengthTexels out;
    out.frame = laid.frame;
    out.factor.reserve(laid.window.width() * laid.window.height());
    laid.for_each([&](const float* pixel, int row, int column) {
        if (laid.unknown.has(pixel[0]) || (image.channels == 2 && pixel[1] == 0.0F)) {
            out.factor.push_back(1.0F);
            return;
        }
        constexpr double most_db = 100.0;
        const double db = scale_db * static_cast<double>(pixel[0]) + offset_db;
        if (!(std::fabs(db) <= most_db)) {
            const std::string value = number_text(static_cast<double>(pixel[0]));
            throw InputError(laid.where, place_text(row, column) + value + " makes " +
                                             number_text(db) +
                                             " dB, and at most 100 are believed; write " +
                                             rule.section + ".no_data: " + value +
                                             " if it marks unknown pixels, else scale_db "
                                             "and offset_db");
        }
        constexpr double per_db = 0.23025850929940457;  // ln(10) / 10
        out.factor.push_back(static_cast<float>(exponential(per_db * db)));
    });
    return out;
}

}  // namespace sonarsim
