#include "simulate/product/soundings.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

/// A multibeam imaging sonar (section III): range by azimuth, elevation is lost. Looks forward.
KindOfSonar imaging_kind() {
    SonarConfig defaults;
    defaults.kind = SonarKind::imaging;
    return {.keys = {.kind = SonarKind::imaging,
                     .name = "imaging",
                     .defaults = defaults,
                     .azimuth_bins = true},
            .shape = ViewShape::fan,
            .looks_down = false,
            .gain = 0.5,
            .has_images = true,
            .finish = add_azimuth};
}

/// A multibeam profiling sonar (section V): an imaging sonar with one narrow bin of elevation.
/// Looks down.
KindOfSonar profiling_kind() {
    SonarConfig defaults;
    defaults.kind = SonarKind::profiling;
    defaults.elevation_deg = 1.0;
    defaults.range_min_m = 0.5;
    defaults.range_max_m = 75.0;
    defaults.range_bins = 750;
    defaults.azimuth_bins = 480;
    return {.keys = {.kind = SonarKind::profiling,
                     .name = "profiling",
                     .defaults = defaults,
                     .azimuth_bins = true},
            .shape = ViewShape::fan,
            .looks_down = true,
            .gain = 0.5,
            .has_images = true,
            .record = {.name = "soundings"},
            .finish = add_azimuth,
            .measure = [](const PingView& view, nlohmann::ordered_json& json) {
                json["soundings"] = beams_with_sounding(view.ping);
            }};
}

}  // namespace sonarsim
