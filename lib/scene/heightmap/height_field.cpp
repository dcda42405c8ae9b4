#include "scene/heightmap/height_field.h"

#include <spdlog/fmt/fmt.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/text.h"
#include "scene/images/read_image.h"
#include "scene/images/unknown_pixels.h"

namespace sonarsim {

namespace {

void require_heights(const Image& image, const Location& where) {
    if (image.channels != 1) {
        throw InputError(where, "has " + std::to_string(image.channels) +
                                    " channels, and a heightmap has one: take one out, as with "
                                    "gdal_translate -b 1");
    }
    if (image.width < 2 || image.height < 2) {
        throw InputError(where, "has " + std::to_string(image.width) + " x " +
                                    std::to_string(image.height) +
                                    " pixels, and a surface needs 2 x 2");
    }
}

/// InputError for a value that is no height. `no_data`: the mark of unknown heights, if one is
/// known.
void require_height(float value, const std::optional<double>& no_data, int row, int column,
                    const Location& where) {
    constexpr std::array<float, 5> usual_marks{-9999.0F, -99999.0F, -32767.0F, -32768.0F,
                                               -2147483648.0F};
    bool is_odd = !(std::fabs(value) <= huge_pixel);
    for (const float mark : usual_marks)
        is_odd = is_odd || (!no_data && value == mark);
    if (!is_odd) return;
    const std::string text = number_text(static_cast<double>(value));
    throw InputError(where,
                     fmt::format("row {}, column {}: {} looks like the mark of an unknown height; "
                                 "write scene.heightmap.no_data: {}, or another number that does "
                                 "not occur if it is a height",
                                 row, column, text, std::isfinite(value) ? text : "3.4e38"));
}

PixelWindow window_of(const Image& image, const PixelGrid& grid, const HeightmapRule& rule,
                      const Location& where) {
    PixelWindow window{0, image.height, 0, image.width};
    if (rule.window) {
        const auto& w = *rule.window;
        window =
            pixels_within(image, grid, {Eigen::Vector2d(w[0], w[1]), Eigen::Vector2d(w[2], w[3])});
    }
    if (window.width() * window.height() <= most_heights) return window;
    throw InputError(where, fmt::format("the mission needs {} x {} heights of it, and at most 2^25 "
                                        "have room; make it coarser with gdal_translate -outsize "
                                        "50% 50%, or cut a part out with gdal_translate -projwin",
                                        window.width(), window.height()));
}

}  // namespace

HeightField read_heights(const std::filesystem::path& path, const HeightmapRule& rule,
                         ImageReader& images) {
    const Location where{path.string()};
    const Image image = images.read(path);
    require_heights(image, where);
    HeightField out;
    out.grid = grid_in_metres(image, rule.pixel_m, rule.size_m, "scene.heightmap", where);
    std::optional<double> no_data = rule.no_data ? rule.no_data : image.reference.no_data;
    if (no_data && std::isnan(*no_data)) no_data.reset();  // NaN is no height anyway
    out.window = window_of(image, out.grid, rule, where);
    const UnknownPixels unknown(no_data);
    const PixelWindow& window = out.window;
    out.heights.reserve(window.width() * window.height());
    out.known.reserve(window.width() * window.height());
    for (int row = window.first_row; row < window.last_row; ++row) {
        for (int column = window.first_column; column < window.last_column; ++column) {
            const float value = *image.pixel(row, column);
            const bool is_known = !unknown.has(value);
            if (is_known) require_height(value, no_data, row, column, where);
            out.known.push_back(is_known);
            out.heights.push_back(value);
        }
    }
    return out;
}

}  // namespace sonarsim
