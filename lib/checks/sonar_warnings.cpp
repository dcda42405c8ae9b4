#include "checks/sonar_warnings.h"

#include <cmath>

namespace sonarsim {

namespace {

// docs/warnings.md has the reason for each limit.
constexpr double many_white = 0.05;  // of the lit bins
constexpr double faint = 0.25;       // of the noise, in the mean
constexpr double fewest_greys = 16.0;

/// Why the blind pings of a sonar are blind.
void judge_blindness(const Sonar& sonar, const SonarSurvey& found, std::vector<Warning>& out) {
    const SonarConfig& config = sonar.config;
    const std::string about = about_sensor(config.name);
    const Blindness& why = found.why;
    if (found.blind == 0) return;
    out.push_back(make_warning(Doubt::blind, about, found.blind, found.pings));
    if (why.too_far > 0) {
        out.push_back(make_warning(Doubt::range_too_short, about, why.too_far, found.pings,
                                   why.in_view_m.low, why.in_view_m.high, config.range_max_m));
    }
    if (why.too_near > 0) {
        out.push_back(make_warning(Doubt::range_begins_late, about, why.too_near, found.pings,
                                   why.ends_m.high, config.range_min_m));
    }
    if (why.too_flat > 0) {
        const bool cone = sonar.settings.view.shape == ViewShape::cone;
        out.push_back(make_warning(Doubt::elevation_too_narrow, about, why.too_flat, found.pings,
                                   why.elevation_deg.low, why.elevation_deg.high,
                                   cone ? "opening_deg" : "elevation_deg",
                                   cone ? config.opening_deg : config.elevation_deg));
    }
    if (why.elsewhere > 0)
        out.push_back(make_warning(Doubt::looks_elsewhere, about, why.elsewhere, found.pings));
    if (why.nothing > 0) {
        const std::string nearest =
            why.nearest_m.empty()
                ? "the scene is empty"
                : fmt::format("the nearest ever is {:.4g} m away or more", why.nearest_m.low);
        out.push_back(make_warning(Doubt::nothing_near, about, why.nothing, found.pings, nearest));
    }
}

}  // namespace

std::vector<Warning> sonar_warnings(const OutputConfig& output, const Sonar& sonar,
                                    double full_scale, const SonarSurvey& found) {
    std::vector<Warning> out;
    const std::string about = about_sensor(sonar.config.name);
    judge_blindness(sonar, found, out);
    if (2 * found.below_surface > found.pings) {
        out.push_back(make_warning(Doubt::below_surface, about, found.below_surface, found.pings));
    }
    if (found.enclosed > 0) {
        out.push_back(make_warning(Doubt::inside_object, about, found.enclosed, found.pings,
                                   found.enclosed_by));
    }
    if (found.blind == found.pings) return out;
    if (found.signal < faint * found.noise)
        out.push_back(make_warning(Doubt::below_noise, about, found.signal, found.noise));
    if (output.full_scale == 0.0) return out;
    const double greys = 255.0 * std::sqrt(found.brightest / full_scale);
    if (found.white_share > many_white) {
        out.push_back(make_warning(Doubt::saturated, about, 100.0 * found.white_share, full_scale,
                                   found.brightest));
    } else if (greys < fewest_greys) {
        out.push_back(make_warning(Doubt::dim, about, found.brightest, greys, full_scale));
    }
    return out;
}

}  // namespace sonarsim
