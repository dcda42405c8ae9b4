#include "hard/cases.h"

namespace sonarsim {

namespace {

using namespace shapes;

std::function<HardTrial(SonarKind)> floor_with(const ConfigChange& change) {
    return [change](SonarKind kind) { return over_floor(kind, change); };
}

/// A room on all sides of the sonar over the floor.
Scene room() {
    Scene scene = empty_scene();
    add_box(scene, {-4, -4, 0}, {5, 5, 6}, add_material(scene, 0.5F));
    return scene;
}

/// Full azimuth. A cone keeps its own, and so does the single beam of a scanning sonar.
void all_azimuths(SonarConfig& config) {
    if (config.kind == SonarKind::echosounder || config.kind == SonarKind::scanning) return;
    config.azimuth_deg = 360.0;
    config.azimuth_bins = 288;
}

/// A floor whose seam runs along the boresight, the edge of two beams: R = 0.5 to port, 0 to
/// starboard.
Scene halves() {
    Scene scene = empty_scene();
    const std::uint32_t port = add_material(scene, 0.5F);
    const std::uint32_t starboard = add_material(scene, 0.0F);
    add_quad(scene, {-30, 0, 0}, {30, 0, 0}, {30, 30, 0}, {-30, 30, 0}, port);
    add_quad(scene, {-30, -30, 0}, {30, -30, 0}, {30, 0, 0}, {-30, 0, 0}, starboard);
    return scene;
}

HardTrial over_seam(SonarKind kind) {
    HardTrial trial = over_floor(kind);
    trial.T_world_vehicle = {rotation_from_rpy(0.0, looks_forward(kind) ? 0.5 : 0.0, 0.0),
                             {0.0, 0.0, 3.0}};
    return trial;
}

/// A single beam receives both halves equally: half of R H / r. Other sonars: R H / r to port,
/// nothing to starboard.
std::vector<float> seam_law(const HardContext& context) {
    const int beams = context.ping.beams;
    const bool both = beams == 1;
    std::vector<float> truth = plane_law(context, both ? 0.25 : 0.5, 3.0);
    for (std::size_t k = 0; k < truth.size() && !both; ++k) {
        if (static_cast<int>(k % static_cast<std::size_t>(beams)) < beams / 2) truth[k] = 0.0F;
    }
    return truth;
}

}  // namespace

std::vector<HardCase> hard_sonar_limits() {
    return {{.name = "8,192 range bins",
             .scene = plain_floor,
             .trial = floor_with([](SonarConfig& c) {
                 c.range_bins = 8192;
                 c.opening_deg = 30.0;
             }),
             .truth = floor_law,
             .bounds = {0.02}},
            {.name = "azimuth of 360 degrees",
             .scene = room,
             .trial = floor_with(all_azimuths),
             .truth = settled_reference,
             .bounds = {0.08}},
            {.name = "a seam on a beam's edge",
             .scene = halves,
             .trial = over_seam,
             .truth = seam_law,
             .bounds = {0.02}}};
}

}  // namespace sonarsim
