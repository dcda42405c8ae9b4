#include <cmath>

#include "core/text.h"
#include "simulate/product/contrast.h"
#include "simulate/product/picture.h"
#include "simulate/product/soundings.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

namespace {

// The echogram as an operator sees it: a depth axis on the left, then a column per ping, the
// nearest range on top. Each bin is a rectangle of pixels, so that short missions are legible.

constexpr int min_width = 600;  // px; met by a whole number of pixels per ping
constexpr int min_height = 400;
constexpr Rgb echo_colours[] = {{8, 10, 40},    {20, 50, 130},  {20, 120, 190}, {60, 190, 150},
                                {230, 220, 80}, {240, 130, 40}, {190, 20, 30}};

int pixels_per_bin(int min_pixels, int bins) {
    return std::max(1, (min_pixels + bins - 1) / std::max(1, bins));
}

StripFrame echogram_frame(const SonarConfig& config, int pings) {
    StripFrame frame;
    frame.axis_width = text_width("1000.0 m") + 12;
    frame.ping_px = pixels_per_bin(min_width, pings);
    frame.bin_px = pixels_per_bin(min_height, config.range_bins);
    frame.width = frame.axis_width + pings * frame.ping_px;
    frame.height = config.range_bins * frame.bin_px;
    return frame;
}

Picture echogram_axis(const SonarConfig& config, const StripFrame& frame) {
    Picture axis(frame.axis_width, frame.height, backdrop);
    const int right = frame.axis_width - 1;
    fill(axis, right, 0, 1, frame.height, ink);
    const double pixels_per_m = frame.height / (config.range_max_m - config.range_min_m);
    for (const double depth : axis_marks(config.range_min_m, config.range_max_m, 8.0)) {
        const int y = static_cast<int>(std::floor((depth - config.range_min_m) * pixels_per_m));
        fill(axis, right - 5, std::min(y, frame.height - 1), 5, 1, ink);
        const int top = std::clamp(y - 3, 0, std::max(0, frame.height - 7));
        write(axis, right - 8, top, number_text(depth) + " m", Align::right, ink);
    }
    return axis;
}

void echogram_row(std::span<const float> bins, double white, const StripFrame& frame,
                  std::span<Rgb> pixels) {
    const auto full = static_cast<float>(white);
    for (std::size_t k = 0; k < bins.size(); ++k) {
        const Rgb colour = blend(echo_colours, shade(bins[k], full));
        std::fill_n(pixels.begin() + static_cast<std::ptrdiff_t>(k) * frame.ping_px, frame.ping_px,
                    colour);
    }
}

/// The slant range of the bottom's leading edge, the middle of its bin; null without surface.
void measure_depth(const PingView& view, nlohmann::ordered_json& json) {
    // A second bottom echo may be the brighter one. Range noise delays echoes.
    const std::vector<double>& edges = view.sonar.range_edges_m;
    const float far_m = farthest_surface_m(view.traced);
    const bool is_delayed = view.sonar.config.noise.range_lambda_m > 0.0;
    const auto end = is_delayed ? edges.end() : std::ranges::upper_bound(edges, far_m);
    const auto bins = std::min<std::ptrdiff_t>(end - edges.begin(), view.ping.range_bins);
    const auto bin = first_return(std::span(view.ping.intensity).first(far_m > 0.0F ? bins : 0));
    const auto depth_m = bin ? std::optional(view.sonar.middle_m(*bin)) : std::nullopt;
    json["depth_m"] = number_or_null(depth_m);
}

}  // namespace

/// An echosounder (section VI): a cone of half-angle opening / 2. Its range noise does not fade.
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
                       .style = {echogram_frame, echogram_axis, echogram_row}},
            .measure = measure_depth};
}

}  // namespace sonarsim
