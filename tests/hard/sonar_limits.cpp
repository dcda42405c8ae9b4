#include "hard/tools.h"
#include "support/shapes.h"

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

void half_sphere(SonarConfig& config) {
    config.elevation_deg = 180.0;
    config.opening_deg = 180.0;
}

/// A sphere whose radius is the edge of a bin, with bins of 1 m from 0 to 10 m.
Scene sphere_on_an_edge() {
    Scene scene = empty_scene();
    add_sphere(scene, {0, 0, 0}, 5.0F, add_material(scene, 0.7F), 512);
    return scene;
}

HardTrial in_sphere_of_edge(SonarKind kind) {
    HardTrial trial = over_floor(kind, [](SonarConfig& c) {
        c.range_min_m = 0.0;
        c.range_bins = 10;
    });
    trial.T_world_vehicle.translation.setZero();
    return trial;
}

/// R in those of the two bins at 5 m that have an echo, and nothing in any other bin.
std::vector<float> edge_law(const HardContext& context) {
    std::vector<float> truth(context.ping.intensity.size(), 0.0F);
    for (int i = 4; i <= 5; ++i) {
        for (int j = 0; j < context.ping.beams; ++j) {
            truth[static_cast<std::size_t>(i) * context.ping.beams + j] =
                context.ping.at(i, j) > 0.0F ? 0.7F : unchecked;
        }
    }
    return truth;
}

/// A floor in two halves whose seam runs along the boresight: the edge between two beams of an even
/// number and between the two sides of a side-scan. R = 0.5 to port, 0 to starboard.
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
    return {{.name = "range_min 0",
             .stresses = "bins from the sonar on",
             .expected = "R H / r",
             .scene = plain_floor,
             .trial = floor_with([](SonarConfig& c) { c.range_min_m = 0.0; }),
             .truth = floor_law,
             .bounds = {0.02}},
            {.name = "one range bin",
             .stresses = "a bin of 9.8 m",
             .expected = "reference",
             .scene = plain_floor,
             .trial = floor_with([](SonarConfig& c) { c.range_bins = 1; }),
             .truth = settled_reference,
             .bounds = {0.03}},
            {.name = "8,192 range bins",
             .stresses = "bins of 1.2 mm",
             .expected = "R H / r",
             .scene = plain_floor,
             .trial = floor_with([](SonarConfig& c) {
                 c.range_bins = 8192;
                 c.opening_deg = 30.0;
             }),
             .truth = floor_law,
             .bounds = {0.02}},
            {.name = "azimuth of 360 degrees",
             .stresses = "a seam behind the sonar",
             .expected = "reference",
             .scene = room,
             .trial = floor_with(all_azimuths),
             .truth = settled_reference,
             .bounds = {0.08}},
            {.name = "elevation of 180 degrees",
             .stresses = "half of all directions",
             .expected = "reference",
             .scene = room,
             .trial = floor_with(half_sphere),
             .truth = settled_reference,
             .bounds = {0.05}},
            {.name = "elevation poles",
             .stresses = "surface straight above and below",
             .expected = "reference",
             .scene = plain_floor,
             .trial =
                 [](SonarKind kind) {
                     HardTrial trial = over_floor(kind, half_sphere);
                     trial.T_world_vehicle.rotation = rotation_from_rpy(0.0, 0.0, 0.0);
                     return trial;
                 },
             .truth = settled_reference,
             .bounds = {0.05}},
            {.name = "samples on a bin's edge",
             .stresses = "a sphere of 5 m, bins of 1 m",
             .expected = "R in two bins, else nothing",
             .scene = sphere_on_an_edge,
             .trial = in_sphere_of_edge,
             .truth = edge_law,
             .bounds = {0.002}},
            {.name = "a seam on a beam's edge",
             .stresses = "nothing may reach the beam next to it",
             .expected = "R H / r on one side",
             .scene = halves,
             .trial = over_seam,
             .truth = seam_law,
             .bounds = {0.02}}};
}

}  // namespace sonarsim
