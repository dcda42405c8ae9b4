#include <cmath>

#include "run/checks/find_warnings.h"

namespace sonarsim {

namespace {

// docs/warnings.md says why these are the limits.
constexpr double many_white = 0.05;  // a share of the occupied bins
constexpr double faint = 0.25;       // a share of the noise's deviation
constexpr double fewest_greys = 16.0;

/// Warns of pings that see nothing: the reasons, then their number.
void judge_blindness(const Sonar& sonar, const SonarSurvey& found, std::vector<Warning>& out) {
    const SonarConfig& config = sonar.config;
    const std::string about = about_sensor(config.name);
    const NoReturnReasons& why = found.no_return;
    const auto add = [&](WarningCode code, std::size_t pings, const auto&... figures) {
        if (pings > 0) out.push_back(make_warning(code, about, pings, found.pings, figures...));
    };
    const std::string depths =
        why.depths == 0 ? "" : "; z points up, and depths are negative: these z look like depths";
    add(WarningCode::range_too_short, why.too_far, why.in_view_m.low, why.in_view_m.high,
        config.range_max_m, depths);
    add(WarningCode::range_begins_late, why.too_near, why.ends_m.high, config.range_min_m);
    const bool cone = sonar.settings.view.shape == ViewShape::cone;
    add(WarningCode::elevation_too_narrow, why.elevation_too_narrow, why.elevation_deg.low,
        why.elevation_deg.high, cone ? "opening_deg" : "elevation_deg",
        cone ? config.opening_deg : config.elevation_deg,
        cone ? "angles off its axis" : "elevations");
    add(WarningCode::looks_elsewhere, why.elsewhere);
    add(WarningCode::nothing_near, why.nothing,
        why.nearest_m.empty()
            ? std::string("the scene is empty")
            : fmt::format("the nearest ever is {:.4g} m away or more", why.nearest_m.low),
        depths);
    add(WarningCode::blind, found.blind);
}

/// Warns of images that are too bright or too dark for the scale of the pictures. With `auto`
/// glints are white on purpose, and a scale found from pings is never too dark. Not for raw/.
void judge_brightness(const OutputConfig& output, const Sonar& sonar, double full_scale,
                      double white_share, float brightest, std::vector<Warning>& out) {
    const EchoModelInfo& info = sonar.settings.model->info;
    if (output.full_scale == 0.0 && info.white == 0.0) return;
    const bool shows_raw = info.raw_bits > 0 && sonar.settings.view.shape == ViewShape::fan;
    if (shows_raw && !output.image) return;
    const std::string about = about_sensor(sonar.config.name);
    const double greys = 255.0 * std::sqrt(brightest / full_scale);
    if (white_share > many_white && output.full_scale > 0.0) {
        out.push_back(make_warning(WarningCode::saturated, about, 100.0 * white_share, full_scale,
                                   brightest));
    } else if (greys < fewest_greys) {
        out.push_back(make_warning(WarningCode::dim, about, brightest, greys, full_scale));
    }
}

/// The key to change, and the amount, so that the mean echo is as strong as the noise.
std::string cure_of_noise(const SonarConfig& config, const SonarSurvey& found) {
    if (config.model == ModelKind::paper) return "lower noise.add_sigma";
    const ReceiverConfig& receiver = config.instrument.receiver;
    const double below_db = 10.0 * std::log10(found.noise / found.signal);
    const std::string by = found.signal > 0.0 ? fmt::format("by {:.0f} dB", std::ceil(below_db))
                                              : "until echoes are above the noise";
    if (receiver.noise_db)
        return fmt::format("lower instrument.receiver.noise_db ({:.4g}) {}", *receiver.noise_db,
                           by);
    return fmt::format(
        "raise instrument.source_level_db {}, or lower "
        "range_max_m; sonarsim preset prints the ranges at which the sonar sees",
        by);
}

}  // namespace

std::vector<Warning> sonar_warnings(const OutputConfig& output, const Sonar& sonar,
                                    double full_scale, const SonarSurvey& found) {
    std::vector<Warning> out;
    const std::string about = about_sensor(sonar.config.name);
    if (2 * found.below_surface > found.pings) {
        out.push_back(
            make_warning(WarningCode::below_surface, about, found.below_surface, found.pings));
    }
    if (found.enclosed > 0) {
        out.push_back(make_warning(WarningCode::inside_object, about, found.enclosed, found.pings,
                                   found.enclosed_by));
    }
    if (10 * found.beyond_edge > found.pings) {
        out.push_back(make_warning(WarningCode::scene_ends, about, found.beyond_edge, found.pings));
    }
    judge_blindness(sonar, found, out);
    if (found.blind == found.pings) return out;
    if (found.signal < faint * found.noise) {
        out.push_back(make_warning(WarningCode::below_noise, about, found.signal, found.noise,
                                   cure_of_noise(sonar.config, found)));
    }
    judge_brightness(output, sonar, full_scale, found.white_share, found.brightest, out);
    return out;
}

std::vector<Warning> image_warnings(const Mission& mission, const Assembly& assembly,
                                    std::span<const SensorSummary> sensors) {
    std::vector<Warning> out;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const SensorSummary& summary = sensors[i];
        const SonarConfig& config = assembly.sonars[i].config;
        if (summary.pings == 0) continue;
        if (summary.dark_pings > 0) {
            out.push_back(make_warning(WarningCode::blind, about_sensor(config.name),
                                       summary.dark_pings, summary.pings));
        }
        if (summary.dark_pings == summary.pings) continue;
        const double white_share = static_cast<double>(summary.clipped_pixels) /
                                   static_cast<double>(summary.counts.occupied_bins);
        judge_brightness(mission.output, assembly.sonars[i], assembly.full_scales[i], white_share,
                         summary.brightest, out);
    }
    return out;
}

}  // namespace sonarsim
