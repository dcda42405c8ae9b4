#include "product/waterfall.h"

#include <cmath>

#include "core/text.h"
#include "product/gain.h"

namespace sonarsim {

namespace {

constexpr int axis_height = 22;
constexpr Rgb copper[] = {{0, 0, 0}, {107, 67, 42}, {204, 127, 81}, {255, 199, 127}};
constexpr Rgb nadir{150, 190, 220};

}  // namespace

Picture waterfall_axis(const SonarConfig& config) {
    const int n = config.range_bins;
    Picture axis(2 * n, axis_height, paper);
    fill(axis, 0, axis_height - 1, axis.width, 1, ink);
    const double bins_per_m = n / (config.range_max_m - config.range_min_m);
    const int label_px = text_width("000.0 m") + 12;
    const auto marks = axis_marks(config.range_min_m, config.range_max_m,
                                  std::max(1.0, static_cast<double>(n) / (1.5 * label_px)));
    for (const double range : marks) {
        const int bin = static_cast<int>(std::floor((range - config.range_min_m) * bins_per_m));
        const std::string text = number_text(range) + " m";
        for (const int x : {n - 1 - bin, n + bin}) {
            fill(axis, x, axis_height - 6, 1, 6, ink);
            // A label beyond the edge or on nadir's would say less than none.
            const int half = text_width(text) / 2 + 2;
            const bool beside_nadir = std::abs(x - n) > half + text_width("nadir") / 2 + 2;
            if (x >= half && x + half < axis.width && beside_nadir) {
                write(axis, x, 5, text, Align::middle, ink);
            }
        }
    }
    if (n > text_width("nadir")) write(axis, n, 5, "nadir", Align::middle, nadir);
    return axis;
}

void waterfall_row(std::span<const float> row, double white, std::span<Rgb> pixels) {
    const auto full = static_cast<float>(white);
    for (std::size_t i = 0; i < row.size(); ++i)
        pixels[i] = blend(copper, shade(row[i], full));
    pixels[row.size() / 2] = nadir;
}

}  // namespace sonarsim
