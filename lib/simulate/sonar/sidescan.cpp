#include "simulate/product/sidescan.h"

#include <cmath>

#include "core/text.h"
#include "simulate/product/contrast.h"
#include "simulate/product/picture.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

namespace {

// The waterfall of a side-scan sonar as an operator sees it, in copper tones: a range axis, then a
// row per ping, the first on top, port on the left, and a line over the first starboard column.

constexpr int axis_height = 22;
constexpr Rgb nadir_colour{150, 190, 220};

StripFrame waterfall_frame(const SonarConfig& config, int pings) {
    return {.axis_height = axis_height,
            .width = waterfall_columns(config),
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
        for (const int x : {nadir - 1 - column, nadir + column}) {
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
        pixels[i] = blend(copper_colours, shade(row[i], full));
    pixels[nadir] = nadir_colour;
}

void measure_first_returns(const PingView& view, nlohmann::ordered_json& json) {
    const auto first = [&](int side) {
        return number_or_null(
            first_return_m(view.traced.samples, view.is_bottom, view.sonar.settings.view, side));
    };
    json["first_return_m"] = {{"port", first(Side::port)}, {"starboard", first(Side::starboard)}};
}

void describe_waterfall(const Sonar& sonar, nlohmann::ordered_json& sensor) {
    sensor["waterfall"] = {{"columns", waterfall_columns(sonar.config)},
                           {"blank_columns_a_side", blank_columns(sonar.config)},
                           {"column_m", sonar.settings.view.bin_m()},
                           {"offset_m", column_offset_m(sonar.config)},
                           {"slant_range",
                            "of the middle of column k: |k + 0.5 - columns / 2| "
                            "column_m + offset_m; blank columns lie before range_min"}};
}

}  // namespace

/// A side-scan sonar (section IV): two beams, starboard and port. No range noise. Looks down.
KindOfSonar sidescan_kind() {
    SonarConfig defaults;
    defaults.kind = SonarKind::sidescan;
    defaults.azimuth_deg = 170.0;
    defaults.elevation_deg = 0.25;
    defaults.range_min_m = 0.5;
    defaults.range_max_m = 35.0;
    defaults.range_bins = 690;
    defaults.instrument.beam.aperture = Aperture::port_starboard;
    defaults.instrument.beam.width_deg = 0.25;
    return {
        .keys = {.kind = SonarKind::sidescan,
                 .name = "sidescan",
                 .defaults = defaults,
                 .range_noise = false},
        .shape = ViewShape::port_starboard,
        .looks_down = true,
        .record = {.name = "waterfall",
                   .axis = "port from range_max to nadir, then starboard from nadir to range_max",
                   .pictures = RecordPictures::strip,
                   .style = {waterfall_frame, waterfall_axis, waterfall_row},
                   .bins = waterfall_bins,
                   .describe = describe_waterfall,
                   .two_sides = true},
        .measure = measure_first_returns};
}

}  // namespace sonarsim
