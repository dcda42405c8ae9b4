#include "simulate/product/echogram.h"
#include "simulate/sonar/kinds.h"
#include "simulate/sonar/setup.h"

namespace sonarsim {

/// An echosounder (section VI): one beam, a cone of half-angle opening / 2. Its range noise does
/// not fade. Looks down.
KindOfSonar echosounder_kind() {
    SonarConfig defaults;
    defaults.kind = SonarKind::echosounder;
    defaults.range_min_m = 0.5;
    defaults.range_bins = 200;
    defaults.instrument.beam.aperture = Aperture::piston;
    defaults.instrument.beam.width_deg = 10.0;
    return {.keys = {.kind = SonarKind::echosounder,
                     .name = "echosounder",
                     .defaults = defaults,
                     .azimuth = false,
                     .elevation = false,
                     .opening = true},
            .shape = ViewShape::cone,
            .looks_down = true,
            .range_noise_fades = false,
            .record = {.name = "echogram",
                       .upright = true,
                       .pictures = RecordPictures::strip,
                       .style = echogram_style},
            // The range at which the bottom is detected.
            .measure = [](const PingView& view, nlohmann::ordered_json& json) {
                json["depth_m"] = number_or_null(detected_depth(view.sonar, view.ping));
            }};
}

}  // namespace sonarsim
