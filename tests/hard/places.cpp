#include "hard/cases.h"

namespace sonarsim {

namespace {

std::vector<float> dark(const HardContext& context) {
    return std::vector<float>(context.ping.intensity.size(), 0.0F);
}

/// Surface behind the sonar, or nearer than the least range: walls 5 cm away all round.
std::vector<HardCase> dark_places() {
    return {
        {.name = "inside a solid",
         .scene = box_scene({0.26F, 0.12F, 2.95F}, {0.36F, 0.22F, 3.05F}, 0.5F),
         .truth = dark},
        {.name = "empty scene", .scene = empty_scene(), .truth = dark},
        {.name = "empty field of view", .scene = floor_scene(30.0F, 8.0F, 0.5F), .truth = dark}};
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

HardCase inside_a_sphere() {
    return {.name = "a closed mesh from inside",
            .scene = sphere_scene({0, 0, 0}, 5.0F, 0.7F, 512),
            .move = [](SonarKind, Pose& pose) { pose.translation.setZero(); },
            .truth = sphere_law,
            .bounds = {0.001}};
}

/// A sonar with multipath on the floor and a wall along the boresight, so near that specular
/// reflections from the floor run along the wall.
HardCase beside_a_wall() {
    Scene scene = plain_floor();
    add_rectangle(scene, {-9, 0.4F, 0}, {20, 0.4F, 6}, 0);
    return {.name = "multipath on a surface",
            .scene = scene,
            .change = [](SonarConfig& c) { c.multipath.method = MultipathMethod::cluster; },
            .move =
                [](SonarKind kind, Pose& pose) {
                    pose = pitched(looks_forward(kind) ? 30.0 : 0.0, {0.0, 0.39, 0.0});
                }};
}

constexpr double grazing_height_m = 1.745e-3;

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

/// A view along the floor: 0.01 degrees at 10 m.
HardCase grazing() {
    return {.name = "grazing incidence",
            .scene = plain_floor(),
            .move =
                [](SonarKind, Pose& pose) {
                    pose = {rotation_from_rpy(0.0, 0.0, 0.1), {0.31, 0.17, grazing_height_m}};
                },
            .truth = grazing_law,
            .bounds = {0.01}};
}

HardCase many_bins() {
    return {.name = "8,192 range bins",
            .scene = plain_floor(),
            .change =
                [](SonarConfig& c) {
                    c.range_bins = 8192;
                    c.opening_deg = 30.0;
                },
            .truth = floor_law,
            .bounds = {0.02}};
}

/// Full azimuth in a room on all sides of the sonar over the floor. A cone keeps its own azimuth,
/// and so does the single beam of a scanning sonar.
HardCase full_azimuth() {
    return {.name = "azimuth of 360 degrees",
            .scene = box_scene({-4, -4, 0}, {5, 5, 6}, 0.5F),
            .change =
                [](SonarConfig& c) {
                    if (c.kind == SonarKind::echosounder || c.kind == SonarKind::scanning) return;
                    c.azimuth_deg = 360.0;
                    c.azimuth_bins = 288;
                },
            .truth = settled_reference,
            .bounds = {0.08}};
}

/// A single beam receives half of R H / r; others R H / r to port, nothing to starboard.
std::vector<float> seam_law(const HardContext& context) {
    const int beams = context.ping.beams;
    const bool both = beams == 1;
    std::vector<float> truth = plane_law(context, both ? 0.25 : 0.5, 3.0);
    for (std::size_t k = 0; k < truth.size() && !both; ++k)
        if (static_cast<int>(k % static_cast<std::size_t>(beams)) < beams / 2) truth[k] = 0.0F;
    return truth;
}

/// A floor whose seam is the boresight, the edge of two beams: R = 0.5 to port, 0 to starboard.
HardCase seam() {
    Scene scene = rectangle_scene({-30, 0, 0}, {30, 30, 0}, 0.5F);
    add_rectangle(scene, {-30, -30, 0}, {30, 0, 0}, add_material(scene, 0.0F));
    return {.name = "a seam on a beam's edge",
            .scene = scene,
            .move =
                [](SonarKind kind, Pose& pose) {
                    pose = pitched(looks_forward(kind) ? degrees(0.5) : 0.0, {0.0, 0.0, 3.0});
                },
            .truth = seam_law,
            .bounds = {0.02}};
}

}  // namespace

std::vector<HardCase> hard_places() {
    std::vector<HardCase> cases = dark_places();
    for (const auto& make :
         {inside_a_sphere, beside_a_wall, grazing, many_bins, full_azimuth, seam})
        cases.push_back(make());
    return cases;
}

}  // namespace sonarsim
