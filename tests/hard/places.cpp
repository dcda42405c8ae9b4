#include "hard/cases.h"

namespace sonarsim {

namespace {

using namespace shapes;

/// Walls 5 cm away all round, nearer than the least range.
Scene narrow_box() {
    Scene scene = empty_scene();
    add_box(scene, {0.26F, 0.12F, 2.95F}, {0.36F, 0.22F, 3.05F}, add_material(scene, 0.5F));
    return scene;
}

/// All surface is behind the sonar.
Scene ceiling() {
    return floor_scene(30.0F, 8.0F, 0.5F);
}

Scene inside_sphere() {
    Scene scene = empty_scene();
    add_sphere(scene, {0, 0, 0}, 5.0F, add_material(scene, 0.7F), 512);
    return scene;
}

HardTrial in_the_centre(SonarKind kind) {
    HardTrial trial = over_floor(kind);
    trial.T_world_vehicle.translation.setZero();
    return trial;
}

/// A sphere about the sonar is at normal incidence everywhere: R in the bin of its radius. The
/// facets' middles lie 5 (1 - cos(pi / 256)) < 0.4 mm nearer, well within the bin of 77 mm.
std::vector<float> sphere_law(const HardContext& context) {
    const View& view = context.trial.sonar.settings.view;
    std::vector<float> truth(context.ping.intensity.size(), 0.0F);
    const auto bin = static_cast<std::size_t>((5.0 - view.range_min_m) / view.bin_m());
    std::fill_n(truth.begin() + static_cast<std::ptrdiff_t>(bin * view.beams), view.beams, 0.7F);
    return truth;
}

/// A wall along the boresight, so near that specular reflections from the floor run along the wall.
Scene wall_along() {
    Scene scene = plain_floor();
    add_quad(scene, {-9, 0.4F, 0}, {20, 0.4F, 0}, {20, 0.4F, 6}, {-9, 0.4F, 6}, 0);
    return scene;
}

/// A sonar with multipath on the floor.
HardTrial beside_the_wall(SonarKind kind) {
    HardTrial trial =
        over_floor(kind, [](SonarConfig& c) { c.multipath.method = MultipathMethod::cluster; });
    trial.T_world_vehicle = {rotation_from_rpy(0.0, looks_forward(kind) ? radians(30.0) : 0.0, 0.0),
                             {0.0, 0.39, 0.0}};
    return trial;
}

constexpr double grazing_height_m = 1.745e-3;

/// A view along the floor: 0.01 degrees at 10 m.
HardTrial grazing(SonarKind kind) {
    HardTrial trial = over_floor(kind);
    trial.T_world_vehicle = {rotation_from_rpy(0.0, 0.0, 0.1), {0.31, 0.17, grazing_height_m}};
    return trial;
}

/// A sonar that looks forward has an echo of the floor in every bin. Sonars that look down have
/// none in range: within 85 degrees of nadir the floor is nearer than 1.745 mm / cos 85 = 20 mm.
std::vector<float> grazing_law(const HardContext& context) {
    if (!looks_forward(context.kind)) return dark(context);
    std::vector<float> truth(context.ping.intensity.size());
    const std::vector<double>& edges = context.trial.sonar.range_edges_m;
    for (std::size_t k = 0; k < truth.size(); ++k) {
        const std::size_t i = k / static_cast<std::size_t>(context.ping.beams);
        truth[k] = static_cast<float>(0.5 * grazing_height_m / (0.5 * (edges[i] + edges[i + 1])));
    }
    return truth;
}

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

HardTrial at_a_seam(SonarKind kind) {
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

std::vector<HardCase> hard_places() {
    return {
        {.name = "inside a solid", .scene = narrow_box, .truth = dark},
        {.name = "empty scene", .scene = [] { return empty_scene(); }, .truth = dark},
        {.name = "empty field of view", .scene = ceiling, .truth = dark},
        {.name = "a closed mesh from inside",
         .scene = inside_sphere,
         .trial = in_the_centre,
         .truth = sphere_law,
         .bounds = {0.001}},
        {.name = "multipath on a surface", .scene = wall_along, .trial = beside_the_wall},
        {.name = "grazing incidence",
         .scene = plain_floor,
         .trial = grazing,
         .truth = grazing_law,
         .bounds = {0.01}},
    };
}

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
             .trial = at_a_seam,
             .truth = seam_law,
             .bounds = {0.02}}};
}

}  // namespace sonarsim
