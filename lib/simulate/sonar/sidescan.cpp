#include "simulate/product/sidescan_row.h"
#include "simulate/product/waterfall.h"
#include "simulate/sonar/kinds.h"
#include "simulate/sonar/setup.h"

namespace sonarsim {

namespace {

/// The range of the first bottom return on either side.
void measure_first_returns(const PingView& view, nlohmann::ordered_json& json) {
    const FirstReturns first = first_returns(view.sonar, view.ping);
    json["first_return_m"] = {{"port", number_or_null(first.port_m)},
                              {"starboard", number_or_null(first.starboard_m)}};
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

/// A side-scan sonar (section IV): two beams, starboard and port, of range bins alone. No range
/// noise. Looks down.
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
        .gain = 1.0,
        .range_noise_fades = true,
        .has_images = false,
        .record = {.name = "waterfall",
                   .axis = "port from range_max to nadir, then starboard from nadir to range_max",
                   .pictures = RecordPictures::strip,
                   .style = waterfall_style,
                   .bins = waterfall_bins,
                   .describe = describe_waterfall,
                   .two_sides = true},
        .measure = measure_first_returns};
}

}  // namespace sonarsim
