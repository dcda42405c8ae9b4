#include "simulate/product/scan.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

namespace {

/// Leaves beam_azimuths_rad empty: noise has no lobe in azimuth, as the head turns over all.
void turn_head(Sonar& sonar) {
    const double half = 0.5 * sonar.settings.view.azimuth_rad;
    sonar.azimuth_edges_rad = edges(-half, half, 1);
    sonar.head_angles_rad = scan_angles_rad(sonar.config);
}

void describe_sweeps(const Sonar& sonar, nlohmann::ordered_json& sensor) {
    sensor["scan"] = {{"pings_per_sweep", scan_steps(sonar.config)},
                      {"step_edges_rad", scan_edges_rad(sonar.config)},
                      {"axes", {"range", "step"}}};
}

}  // namespace

/// A mechanical scanning sonar, such as a Ping360 or a Micron: a single beam whose head turns a
/// step from ping to ping, all the way round or back and forth over a sector. It looks forward, and
/// the head turns about the vertical. The paper has no such sonar. Defaults are those of the
/// Ping360's data sheet (Blue Robotics): beam 2 x 25 degrees, from 0.75 m, 400 steps to the turn.
KindOfSonar scanning_kind() {
    SonarConfig defaults;
    defaults.kind = SonarKind::scanning;
    defaults.azimuth_deg = 2.0;
    defaults.elevation_deg = 25.0;
    defaults.range_min_m = 0.75;
    defaults.range_max_m = 20.0;
    defaults.range_bins = 500;
    defaults.instrument.beam.aperture = Aperture::head;
    return {
        .keys = {.kind = SonarKind::scanning,
                 .name = "scanning",
                 .defaults = defaults,
                 .head = true},
        .shape = ViewShape::fan,
        .looks_down = false,
        .record = {.name = "scan", .pictures = RecordPictures::sweeps, .describe = describe_sweeps},
        .finish = turn_head,
        .measure = [](const PingView& view, nlohmann::ordered_json& json) {
            json["head_angle_rad"] = head_angle_rad(view.sonar, view.pose);
        }};
}

}  // namespace sonarsim
