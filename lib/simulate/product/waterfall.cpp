#include "simulate/product/waterfall.h"

#include <cmath>

#include "core/text.h"
#include "simulate/product/colour_map.h"
#include "simulate/product/gain.h"
#include "simulate/product/sidescan_row.h"

namespace sonarsim {

namespace {

constexpr int axis_height = 22;
constexpr Rgb nadir_colour{150, 190, 220};

}  // namespace

StripFrame waterfall_frame(const SonarConfig& config, int pings) {
    return {.axis_height = axis_height,
            .width = waterfall_columns(config) + 1,
            .height = axis_height + pings};
}

Picture waterfall_axis(const SonarConfig& config, const StripFrame& frame) {
    const int nadir = frame.width / 2;  // column of the nadir line
    Picture axis(frame.width, axis_height, backdrop);
    fill(axis, 0, axis_height - 1, axis.width, 1, ink);
    const double columns_per_m = nadir / config.range_max_m;
    const int label_px = text_width("000.0 m") + 12;
    const auto marks = axis_marks(0.0, config.range_max_m,
                                  std::max(1.0, static_cast<double>(nadir) / (1.5 * label_px)));
    for (const double range : marks) {
        const int column = static_cast<int>(std::floor(range * columns_per_m));
        const std::string text = number_text(range) + " m";
        for (const int x : {nadir - 1 - column, nadir + 1 + column}) {
            fill(axis, x, axis_height - 6, 1, 6, ink);
            // Labels must not be cut off or overlap the label of nadir.
            const int half = text_width(text) / 2 + 2;
            const bool beside_nadir = std::abs(x - nadir) > half + text_width("nadir") / 2 + 2;
            if (x >= half && x + half < axis.width && beside_nadir) {
                write(axis, x, 5, text, Align::middle, ink);
            }
        }
    }
    if (nadir > text_width("nadir")) write(axis, nadir, 5, "nadir", Align::middle, nadir_colour);
    return axis;
}

void waterfall_row(std::span<const float> row, double white, const StripFrame& /*frame*/,
                   std::span<Rgb> pixels) {
    const auto full = static_cast<float>(white);
    const std::size_t nadir = row.size() / 2;
    for (std::size_t i = 0; i < row.size(); ++i)
        pixels[i < nadir ? i : i + 1] = blend(copper_colours, shade(row[i], full));
    pixels[nadir] = nadir_colour;
}

}  // namespace sonarsim
