#include "validation/hard/tools.h"
#include "validation/shapes.h"

namespace sonarsim {

namespace {

using namespace shapes;

std::function<HardTrial(SonarKind)> floor_with(const Tweak& tweak) {
    return [tweak](SonarKind kind) { return over_floor(kind, tweak); };
}

std::vector<float> floor_law(const HardLook& look) {
    return plane_law(look, 0.5, 3.0);
}

/// Room to all sides of the sonar over the floor.
Scene room() {
    Scene scene = empty_scene();
    add_box(scene, {-4, -4, 0}, {5, 5, 6}, add_material(scene, 0.5F));
    return scene;
}

/// All round. A cone has no more azimuth than it always has.
void all_azimuths(SonarConfig& config) {
    if (config.kind == SonarKind::echosounder) return;
    config.azimuth_deg = 360.0;
    config.azimuth_bins = 288;
}

void half_sphere(SonarConfig& config) {
    config.elevation_deg = 180.0;
    config.opening_deg = 180.0;
}

/// With 1 m bins from 0 to 10 m the radius of this sphere is the edge of a bin.
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

/// The two bins that meet at 5 m are R where they are lit and no other is.
std::vector<float> edge_law(const HardLook& look) {
    std::vector<float> truth(look.ping.intensity.size(), 0.0F);
    for (int i = 4; i <= 5; ++i) {
        for (int j = 0; j < look.ping.beams; ++j) {
            truth[static_cast<std::size_t>(i) * look.ping.beams + j] =
                look.ping.at(i, j) > 0.0F ? 0.7F : ignored;
        }
    }
    return truth;
}

/// A floor in two halves whose seam runs along the boresight, the edge between two beams of an even
/// number and between the two sides of a side-scan: port is of R = 0.5, starboard echoes nothing.
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
    trial.T_world_vehicle = {rotation_from_rpy(0.0, kind == SonarKind::imaging ? 0.5 : 0.0, 0.0),
                             {0.0, 0.0, 3.0}};
    return trial;
}

/// A cone sees both halves alike: half of R H / r. Others: all of it to port, nothing to starboard.
std::vector<float> seam_law(const HardLook& look) {
    const bool cone = look.kind == SonarKind::echosounder;
    std::vector<float> truth = plane_law(look, cone ? 0.25 : 0.5, 3.0);
    const int beams = look.ping.beams;
    for (std::size_t k = 0; k < truth.size() && !cone; ++k) {
        if (static_cast<int>(k % static_cast<std::size_t>(beams)) < beams / 2) truth[k] = 0.0F;
    }
    return truth;
}

/// Rays that suffice for what is not thin.
std::vector<float> reference(const HardLook& look) {
    return reference_of(look, {0.002, 64.0, 2'000'000});
}

}  // namespace

// The octree's cells are rows of tan(elevation), which has no end at 90 degrees: missions that look
// there with it are refused.
std::vector<HardCase> hard_sonar_limits() {
    return {
        {"range_min 0",
         "bins from the sonar on",
         "R H / r",
         plain_floor,
         floor_with([](SonarConfig& c) { c.range_min_m = 0.0; }),
         floor_law,
         {0.02, 0.02}},
        {"one range bin",
         "a bin of 9.8 m",
         "reference",
         plain_floor,
         floor_with([](SonarConfig& c) { c.range_bins = 1; }),
         reference,
         {0.03, 0.25}},
        {"8,192 range bins",
         "bins of 1.2 mm",
         "R H / r",
         plain_floor,
         floor_with([](SonarConfig& c) {
             c.range_bins = 8192;
             c.opening_deg = 30.0;
         }),
         floor_law,
         {0.02, 0.02}},
        {"azimuth of 360 degrees",
         "a seam behind the sonar",
         "reference",
         room,
         floor_with(all_azimuths),
         reference,
         {0.08, 0.20}},
        {"elevation of 180 degrees",
         "half of all directions",
         "reference",
         room,
         floor_with(half_sphere),
         reference,
         {0.05, 0.08},
         false,
         0.0,
         {},
         true},
        {"elevation poles",
         "surface straight above and below",
         "reference",
         plain_floor,
         [](SonarKind kind) {
             HardTrial trial = over_floor(kind, half_sphere);
             trial.T_world_vehicle.rotation = rotation_from_rpy(0.0, 0.0, 0.0);
             return trial;
         },
         reference,
         {0.05, 0.08},
         false,
         0.0,
         {},
         true},
        {"samples on a bin's edge",
         "a sphere of 5 m, bins of 1 m",
         "R in two bins, else nothing",
         sphere_on_an_edge,
         in_sphere_of_edge,
         edge_law,
         {0.002, 0.02}},
        {"a seam on a beam's edge",
         "nothing may reach the beam beside",
         "R H / r on one side",
         halves,
         over_seam,
         seam_law,
         {0.02, 0.05}},
    };
}

}  // namespace sonarsim
