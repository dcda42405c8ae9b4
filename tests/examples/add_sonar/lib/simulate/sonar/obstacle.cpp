#include "simulate/product/contrast.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

namespace {

constexpr Rgb greys[] = {{0, 0, 0}, {255, 255, 255}};

// The picture of the record: a row per ping in grey, the nearest range on the left, no axis.

StripFrame obstacles_frame(const SonarConfig& config, int pings) {
    return {.width = config.range_bins, .height = pings};
}

Picture obstacles_axis(const SonarConfig& /*config*/, const StripFrame& frame) {
    return {frame.width, 0, backdrop};
}

void obstacles_row(std::span<const float> ping, double white, const StripFrame& /*frame*/,
                   std::span<Rgb> pixels) {
    for (std::size_t i = 0; i < ping.size(); ++i)
        pixels[i] = blend(greys, shade(ping[i], static_cast<float>(white)));
}

}  // namespace

/// An obstacle-avoidance sonar: one cone that looks ahead. Its record is obstacles.npy, float32
/// [ping, range].
KindOfSonar obstacle_kind() {
    SonarConfig defaults;
    defaults.kind = SonarKind::obstacle;
    defaults.opening_deg = 15.0;
    defaults.range_min_m = 0.5;
    defaults.range_max_m = 40.0;
    defaults.range_bins = 400;
    defaults.instrument.beam.aperture = Aperture::piston;
    defaults.instrument.beam.width_deg = 10.0;
    return {.keys = {.kind = SonarKind::obstacle,
                     .name = "obstacle",
                     .defaults = defaults,
                     .azimuth = false,
                     .elevation = false,
                     .opening = true},
            .shape = ViewShape::cone,
            .looks_down = false,
            .gain = 1.0,
            .range_noise_fades = true,
            .has_images = false,
            .record = {.name = "obstacles",
                       .pictures = RecordPictures::strip,
                       .style = {obstacles_frame, obstacles_axis, obstacles_row}}};
}

}  // namespace sonarsim
